// How a stage describes itself to the plan.
#pragma once

#include <initializer_list>

#include <restir/session.h>

namespace restir {

inline void addUse(PassInfo& pass, PassInfo::Use use) noexcept { pass.useList[pass.useCount++] = use; }

inline PassInfo makePass(const char* name, std::initializer_list<PassInfo::Use> uses) noexcept {
    PassInfo pass{.name = name};
    for (const PassInfo::Use& use : uses) addUse(pass, use);
    return pass;
}

constexpr Resource reservoirs(uint32_t buffer) noexcept {
    return buffer == 0 ? Resource::ReservoirsA : Resource::ReservoirsB;
}

}   // namespace restir
