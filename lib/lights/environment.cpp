#include <lights/environment.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include <device/barrier.h>
#include <device/messages.h>
#include <lights/alias.h>

namespace restir {
namespace {

constexpr uint32_t kMostTexelsASide = 32768;
constexpr VkDeviceSize kTexelBytes = sizeof(gpu::RsEnvironmentTexel);

std::array<BufferRequest, 2> requestsOf(uint32_t maxTexels) {
    const VkDeviceSize bytes = std::max(maxTexels, 1u) * kTexelBytes;   // the binding is always there
    return {{{bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
              MemoryUse::DeviceOnly, "environment table"},
             {bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::HostWrite, "environment staging"}}};
}

std::vector<double> luminances(const EnvironmentMap& map) {
    std::vector<double> result(size_t{map.width} * map.height);
    for (size_t i = 0; i < result.size(); ++i)
        result[i] = 0.2126 * double(map.rgb[3 * i]) + 0.7152 * double(map.rgb[3 * i + 1]) +
                    0.0722 * double(map.rgb[3 * i + 2]);
    return result;
}

// Means over texels of what lies between texel centres, interpolated linearly: an eighth of each neighbour's
// along each axis. So nothing that shines has probability 0.
std::vector<double> filtered(const EnvironmentMap& map, const std::vector<double>& values) {
    const uint32_t w = map.width, h = map.height;
    std::vector<double> across(values.size()), result(values.size());
    for (uint32_t y = 0; y < h; ++y) {
        const double* row = &values[size_t{y} * w];
        for (uint32_t x = 0; x < w; ++x)
            across[size_t{y} * w + x] = 0.75 * row[x] + 0.125 * (row[(x + w - 1) % w] + row[(x + 1) % w]);
    }
    for (uint32_t y = 0; y < h; ++y) {
        const double *row = &across[size_t{y} * w], *above = &across[size_t{y > 0 ? y - 1 : 0} * w],
                     *below = &across[size_t{std::min(y + 1, h - 1)} * w];
        for (uint32_t x = 0; x < w; ++x)
            result[size_t{y} * w + x] = 0.75 * row[x] + 0.125 * (above[x] + below[x]);
    }
    return result;
}

Status check(const MessageSink& sink, const EnvironmentMap& map, uint32_t maxTexels) noexcept {
    if (map.width == 0 || map.height == 0 || map.width > kMostTexelsASide || map.height > kMostTexelsASide)
        return refuse(sink, "restir: EnvironmentMap is %ux%u texels, must be in [1, %u]", map.width,
                      map.height, kMostTexelsASide);
    const size_t texels = size_t{map.width} * map.height;
    if (texels > maxTexels)
        return refuse(sink,
                      "restir: EnvironmentMap has %zu texels, LightTableDesc::maxEnvironmentTexels is %u",
                      texels, maxTexels);
    if (map.rgb.size() != 3 * texels)
        return refuse(sink, "restir: EnvironmentMap::rgb has %zu floats, not 3 x %u x %u", map.rgb.size(),
                      map.width, map.height);
    for (size_t i = 0; i < map.rgb.size(); ++i)
        if (!(map.rgb[i] >= 0 && map.rgb[i] <= float(RS_LIGHT_LARGEST)))
            return refuse(sink, "restir: EnvironmentMap::rgb is %g at texel (%zu, %zu), must be in [0, 1e30]", double(map.rgb[i]),
                          i / 3 % map.width, i / 3 / map.width);
    return Status::Ok;
}

}   // namespace

EnvironmentImportance weighEnvironment(const EnvironmentMap& map) {
    EnvironmentImportance result;
    std::vector<double> weights = filtered(map, luminances(map));
    for (uint32_t y = 0; y < map.height; ++y) {
        const double top = std::numbers::pi * y / map.height,
                     bottom = std::numbers::pi * (y + 1) / map.height;
        const double solidAngle = 2 * std::numbers::pi / map.width * (std::cos(top) - std::cos(bottom));
        for (uint32_t x = 0; x < map.width; ++x)
            result.luminance += weights[size_t{y} * map.width + x] *= solidAngle;
    }
    const std::vector<gpu::RsAliasEntry> alias = makeAliasTable(weights);
    const std::vector<double> probability = aliasProbabilities(alias);
    result.texels.resize(weights.size());
    for (size_t i = 0; i < alias.size(); ++i)
        result.texels[i] = {
            .threshold = alias[i].threshold, .alias = alias[i].alias, .probability = float(probability[i])};
    return result;
}

Result<EnvironmentTable> EnvironmentTable::create(const Device& device, uint32_t maxTexels) noexcept {
    auto buffers = Buffers::create(device, requestsOf(maxTexels));
    if (!buffers) return buffers.error();
    EnvironmentTable table;
    table.buffers_ = std::move(*buffers);
    table.maxTexels_ = maxTexels;
    return table;
}

VkDeviceSize EnvironmentTable::memoryNeeded(const Device& device, uint32_t maxTexels) noexcept {
    return Buffers::memoryNeeded(device, requestsOf(maxTexels));
}

Status EnvironmentTable::upload(const MessageSink& sink, const EnvironmentMap& map) noexcept {
    if (Status s = check(sink, map, maxTexels_); s != Status::Ok) return s;
    const EnvironmentImportance importance = weighEnvironment(map);
    std::memcpy(buffers_.mapped<uint8_t>(1), importance.texels.data(),
                importance.texels.size() * kTexelBytes);
    extent_ = {map.width, map.height};
    luminance_ = importance.luminance;
    pending_ = true;
    return Status::Ok;
}

void EnvironmentTable::record(const Device& device, VkCommandBuffer cmd) noexcept {
    if (!pending_) return;
    pending_ = false;
    const VkBufferCopy all{.size = VkDeviceSize{extent_.x} * extent_.y * kTexelBytes};
    const Functions& functions = device.functions;
    const VkPipelineStageFlags2 passes = device.passStages;
    constexpr VkPipelineStageFlags2 copy = VK_PIPELINE_STAGE_2_COPY_BIT;
    constexpr VkAccessFlags2 wrote = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    memoryBarrier(functions, cmd, {passes | copy, wrote}, {copy, wrote});
    functions.vkCmdCopyBuffer(cmd, buffers_.buffer(1), buffers_.buffer(0), 1, &all);
    memoryBarrier(functions, cmd, {copy, wrote}, {passes, VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
}

}   // namespace restir
