#include <device/functions.h>

namespace restir {
namespace {

// The one cast Vulkan asks for.
template <class F>
bool assign(F& function, PFN_vkVoidFunction address) noexcept {
    function = reinterpret_cast<F>(address);
    return function != nullptr;
}

}   // namespace

const char* loadInstanceFunctions(const DeviceInfo& info, Functions& f) noexcept {
#define RESTIR_LOAD(name) \
    if (!assign(f.name, info.getInstanceProcAddr(info.instance, #name))) return #name;
    RESTIR_INSTANCE_FUNCTIONS(RESTIR_LOAD)
#undef RESTIR_LOAD
    return nullptr;
}

const char* loadDeviceFunctions(const DeviceInfo& info, RayBackend rays, Functions& f) noexcept {
#define RESTIR_LOAD(name) \
    if (!assign(f.name, f.vkGetDeviceProcAddr(info.device, #name))) return #name;
    RESTIR_DEVICE_FUNCTIONS(RESTIR_LOAD)
    if (rays == RayBackend::Pipeline) {
        RESTIR_RAY_PIPELINE_FUNCTIONS(RESTIR_LOAD)
    }
#undef RESTIR_LOAD
    // The instance is asked first: where the extension is off a device's layers may give an address all the same.
#define RESTIR_LOAD(name) \
    if (info.getInstanceProcAddr(info.instance, #name)) assign(f.name, f.vkGetDeviceProcAddr(info.device, #name));
    RESTIR_OPTIONAL_FUNCTIONS(RESTIR_LOAD)
#undef RESTIR_LOAD
    return nullptr;
}

}   // namespace restir
