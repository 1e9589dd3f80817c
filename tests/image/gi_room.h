// Rooms in which light is scattered more than once, settings of indirect light, and their comparison with the reference path
// tracer, which shares no code with it.
#pragma once

#include <functional>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {

inline constexpr VkExtent2D kGiExtent{32, 32};
inline constexpr uint32_t kGiPictures = 20, kGiFrames = 6, kGiBounces = 3;

restir::Settings indirect();
NamedSettings named(const std::string& name, const std::function<void(restir::GiSettings&)>& change);

void expectAgreement(World& world, const ReferenceBlocks& truth, const std::vector<NamedSettings>& all,
                     uint32_t pictures = kGiPictures, uint32_t frames = kGiFrames);
void expectReference(samples::SceneData scene, const std::vector<NamedSettings>& all,
                     uint32_t pictures = kGiPictures);

// Walls seen from inside.
void addRoom(samples::SceneData& scene, const samples::build::Surface& surface, glm::vec3 low, glm::vec3 high);
// A closed room with one lamp and two boxes: what the lamp does not see is lit by the walls alone.
samples::SceneData room(const samples::build::Surface& boxes);

inline samples::build::Surface matte() { return {.color = kAlbedo, .roughness = 1, .specular = 0}; }

// A room of diffuse boxes and a host that looks into it.
class RoomHost {
public:
    explicit RoomHost(uint32_t pairedNeighbours = 0) : RoomHost(room(matte()), pairedNeighbours) {}

private:
    RoomHost(samples::SceneData data, uint32_t pairedNeighbours)
        : view_(data.views[0]), scene_(device(), std::move(data)),
          view(scene_, view_, {.maxExtent = kGiExtent, .pairedNeighbours = pairedNeighbours, .indirect = true}) {}

    samples::View view_;
    samples::GpuScene scene_;

public:
    HostView view;
};

}   // namespace tests
