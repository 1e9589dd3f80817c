#include <device/device.h>

namespace restir {

void Device::name(VkObjectType type, uint64_t handle, const char* text) const noexcept {
    if (!functions.vkSetDebugUtilsObjectNameEXT) return;
    char full[96];
    std::snprintf(full, sizeof full, "restir %s", text);
    const VkDebugUtilsObjectNameInfoEXT nameInfo{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                                 .objectType = type,
                                                 .objectHandle = handle,
                                                 .pObjectName = full};
    functions.vkSetDebugUtilsObjectNameEXT(info.device, &nameInfo);
}

}   // namespace restir
