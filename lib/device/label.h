#pragma once

#include <device/functions.h>

namespace restir {

// Names what is recorded while it lives, for debuggers and captures.
class Label {
public:
    Label(const Functions& f, VkCommandBuffer cmd, const char* name) noexcept : f_(f), cmd_(cmd) {
        const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = name};
        if (f_.vkCmdBeginDebugUtilsLabelEXT) f_.vkCmdBeginDebugUtilsLabelEXT(cmd_, &label);
    }
    ~Label() {
        if (f_.vkCmdEndDebugUtilsLabelEXT) f_.vkCmdEndDebugUtilsLabelEXT(cmd_);
    }
    Label(const Label&) = delete;
    Label& operator=(const Label&) = delete;

private:
    const Functions& f_;
    VkCommandBuffer cmd_;
};

}   // namespace restir
