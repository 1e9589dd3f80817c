// A driver that fails on demand: the SDK gets all its functions through the host, and this host hands out its
// own for every call that can fail and for what frees what they made.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <restir/device.h>

namespace tests::faults {

// The same device, seen through here. One at a time in a program.
restir::DeviceInfo wrap(restir::DeviceInfo info);

// Forgets what was counted; nothing fails. Live objects stay known.
void reset();
// The call after `calls` more ones fails, once, with undefined (poisoned) results.
void failCallAfter(uint32_t calls, VkResult result);
void failNames();   // every vkSetDebugUtilsObjectNameEXT from now on; not one of the calls counted
void hideTimestamps();   // until reset(): no queue has any
// The look-up of a function after so many more ones finds nothing, once.
void failLookupAfter(uint32_t lookups);

uint32_t calls();   // that could have failed, since reset()
std::vector<std::string> callNames();   // of those
uint32_t lookups();
const std::string& failed();   // the call or function that failed, empty: none did
uint32_t strangers();          // objects that were freed without being alive, since reset()
std::string live();            // objects alive by type, empty: none

}   // namespace tests::faults
