#include "viewer/display.h"

#include <array>
#include <utility>

#include "display.spv.h"

namespace viewer {
namespace {

constexpr uint32_t kTileSide = 8;

// Constants and Tile in display.glsl.
struct Constants {
    uint32_t extent[2];
    float exposure, line;
    uint32_t showsDebug, referenceFrames;
    float referenceMean;
    uint32_t firstTile;
};
static_assert(sizeof(Constants) == 32);
struct Tile {
    float radiance[3], error, reference, pixels;
};
static_assert(sizeof(Tile) == 24);

VkExtent2D tilesOf(VkExtent2D extent) {
    return {(extent.width + kTileSide - 1) / kTileSide, (extent.height + kTileSide - 1) / kTileSide};
}

}   // namespace

Display::Display(const samples::Device& device, const samples::GpuScene& scene, VkExtent2D extent,
                 const Inputs& inputs)
    : extent_(extent),
      tiles_(tilesOf(extent)),
      mean_(device, extent, VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT),
      shown_(device, extent, VK_FORMAT_R8G8B8A8_UNORM,
             VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT),
      findings_(device, {.size = samples::FrameSlots::kCount * VkDeviceSize{tiles_.width} * tiles_.height *
                                 sizeof(Tile),
                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                         .memory = samples::MemoryKind::Readback}),
      pass_(device, scene, k_display_spv,
            std::array{inputs.radiance, inputs.debug, inputs.paths, mean_.view(), shown_.view()},
            sizeof(Constants), std::array{findings_.handle()}) {
    device.submitAndWait([&](VkCommandBuffer cmd) {
        const samples::Access shader{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                     VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL};
        samples::pipelineBarrier(cmd, {{samples::imageBarrier(mean_, {}, shader)}});
    });
}

void Display::record(VkCommandBuffer cmd, uint32_t slot, const DisplaySettings& settings) {
    constexpr VkPipelineStageFlags2 kShader = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                    kReaders = VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT;
    constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
                             kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    const samples::Access written{kShader, kWrite, VK_IMAGE_LAYOUT_GENERAL};
    samples::memoryBarrier(cmd, {kShader, kWrite}, {kShader, kRead | kWrite});
    samples::pipelineBarrier(cmd, {{samples::imageBarrier(shown_, {kReaders}, written)}});
    recorded_[slot] = {.frame = true, .reference = settings.referenceFrames > 0};
    pass_.record(cmd, extent_,
                 Constants{.extent = {extent_.width, extent_.height},
                           .exposure = settings.exposure,
                           .line = settings.line * static_cast<float>(extent_.width),
                           .showsDebug = settings.debug ? 1u : 0u,
                           .referenceFrames = settings.referenceFrames,
                           .referenceMean = static_cast<float>(referenceMean_),
                           .firstTile = slot * tiles_.width * tiles_.height});
    samples::pipelineBarrier(cmd, {{samples::imageBarrier(shown_, written,
                                                          {kReaders, VK_ACCESS_2_TRANSFER_READ_BIT,
                                                           VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL})}});
    samples::memoryBarrier(cmd, {kShader, kWrite}, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

std::optional<Findings> Display::collect(uint32_t slot) {
    const Recorded recorded = std::exchange(recorded_[slot], {});
    if (!recorded.frame) return std::nullopt;
    const size_t count = size_t{tiles_.width} * tiles_.height;
    const auto* tiles = reinterpret_cast<const Tile*>(findings_.mapped()) + slot * count;
    Findings findings{.thumbnail = {tiles_.width, tiles_.height, {}}, .error = {}};
    double error = 0, reference = 0, pixels = 0;
    for (size_t i = 0; i < count; ++i) {
        findings.thumbnail.rgb.insert(findings.thumbnail.rgb.end(), tiles[i].radiance, tiles[i].radiance + 3);
        error += double(tiles[i].error);
        reference += double(tiles[i].reference);
        pixels += double(tiles[i].pixels);
    }
    if (!recorded.reference || pixels == 0) return findings;
    // The first frame measured has no mean yet to be relative to.
    if (referenceMean_ > 0) findings.error = error / pixels;
    referenceMean_ = reference / pixels;
    return findings;
}

}   // namespace viewer
