// In place of the generated one, whose million words of SPIR-V take longer to read than all of the library.
#pragma once

#include <restir/context.h>

constexpr restir::ShaderPack kEmbeddedQueryPack, kEmbeddedPipelinePack, kEmbeddedSoftwarePack;
