// What the panels show besides the State.
#pragma once

#include "viewer/history.h"
#include "viewer/picture.h"

namespace viewer {

struct Facts {
    const samples::Device& device;
    const Stage& stage;
    const History& history;
    VkExtent2D extent{};                      // of the picture
    std::vector<restir::BufferInfo> memory;   // the SDK's
    restir::Counters counters;
    uint32_t referenceFrames = 0;
    std::string loading;   // a scene that is waited for; empty: none
};

}   // namespace viewer
