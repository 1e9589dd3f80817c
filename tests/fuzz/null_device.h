// A Vulkan device on which nothing runs and every call succeeds. It looks at what it is told, and ends the
// program where a copy, a fill, a descriptor or a dispatch leaves its bounds. What is mapped has exactly the
// size that was asked for.
#pragma once

#include <restir/device.h>

namespace fuzz {

restir::DeviceInfo nullDevice();
// Any handle that is not null.
template <class Handle>
Handle someHandle() {
    static int target;
    return reinterpret_cast<Handle>(&target);
}

}   // namespace fuzz
