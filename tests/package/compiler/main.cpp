#include <restir/compiler.h>

int main() {
    const char* const passes[] = {"surface.pack", "di.shade"};
    const auto pack = restir::compilePasses({.includeDirectory = INCLUDES, .shaderDirectory = SHADERS, .passes = passes});
    return pack && pack->pack().modules.size() == 2 && pack->pack().shaderAbi == RESTIR_SHADER_ABI ? 0 : 1;
}
