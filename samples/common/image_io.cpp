#include "image_io.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <stb/stb_image_write.h>
#include <glm/glm.hpp>

namespace samples {

namespace {

namespace shown {
using namespace glm;
#define TONE_MAP_FUNCTION inline
#include "common/shaders/include/tone_map.glsl"
}   // namespace shown

constexpr size_t kChannels = 3;
constexpr size_t kMaxPixels = size_t{1} << 28;
constexpr const char* kChannelNames[kChannels] = {"R", "G", "B"};

void checkShape(const std::string& path, const FloatImage& image) {
    const size_t pixels = size_t{image.width} * image.height;
    if (pixels == 0 || pixels > kMaxPixels || image.rgb.size() != pixels * kChannels ||
        (!image.alpha.empty() && image.alpha.size() != pixels))
        throw std::runtime_error(path + ": cannot be written, the image has no pixels or the wrong size");
}

// Calls write(temporary path), then renames; no temporary file survives a failure.
void writeThenRename(const std::string& path, const std::function<void(const std::string&)>& write) {
    const std::string partial = path + ".partial";
    try {
        write(partial);
        std::filesystem::rename(partial, path);
    } catch (const std::exception& exception) {
        std::error_code ignored;
        std::filesystem::remove(partial, ignored);
        throw std::runtime_error(path + ": cannot be written: " + exception.what());
    }
}

// One slice per channel, all into (or from) interleaved pixels whose first one is (origin.x, origin.y).
Imf::FrameBuffer interleaved(float* pixels, size_t width, const Imath::V2i& origin, bool gray) {
    Imf::FrameBuffer buffer;
    constexpr size_t kStride = kChannels * sizeof(float);
    const auto offset = static_cast<std::ptrdiff_t>(width) * origin.y + origin.x;
    for (size_t c = 0; c < (gray ? 1 : kChannels); ++c) {
        char* base = reinterpret_cast<char*>(pixels + c) - offset * static_cast<std::ptrdiff_t>(kStride);
        buffer.insert(gray ? "Y" : kChannelNames[c], Imf::Slice(Imf::FLOAT, base, kStride, width * kStride));
    }
    return buffer;
}

FloatImage readPixels(Imf::InputFile& file) {
    const Imath::Box2i window = file.header().dataWindow();
    const auto width = static_cast<int64_t>(window.max.x) - window.min.x + 1;
    const auto height = static_cast<int64_t>(window.max.y) - window.min.y + 1;
    if (width <= 0 || height <= 0 || static_cast<size_t>(width) > kMaxPixels / static_cast<size_t>(height))
        throw std::runtime_error("bad dataWindow");
    const Imf::ChannelList& channels = file.header().channels();
    const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
    const bool gray = !has("R") && has("Y");
    if (!gray && !(has("R") && has("G") && has("B"))) throw std::runtime_error("has no channels R, G, B");
    FloatImage image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    image.rgb.resize(static_cast<size_t>(width * height) * kChannels);
    file.setFrameBuffer(interleaved(image.rgb.data(), image.width, window.min, gray));
    file.readPixels(window.min.y, window.max.y);
    for (size_t i = 0; gray && i < image.rgb.size(); i += kChannels)
        image.rgb[i + 1] = image.rgb[i + 2] = image.rgb[i];
    return image;
}

glm::vec3 pixel(const FloatImage& image, size_t index) {
    const float* rgb = &image.rgb[index * kChannels];
    const glm::vec3 color{rgb[0], rgb[1], rgb[2]};
    return std::isfinite(color.x + color.y + color.z) ? glm::max(color, glm::vec3{0}) : glm::vec3{0};
}

uint8_t displayByte(float linear) {
    return static_cast<uint8_t>(std::lround(shown::encodeSrgb(linear) * 255));
}

std::vector<uint8_t> displayBytes(const FloatImage& image, float exposure) {
    std::vector<uint8_t> bytes;
    bytes.reserve(image.rgb.size());
    for (size_t i = 0; i < size_t{image.width} * image.height; ++i) {
        const glm::vec3 color = shown::toneMap(pixel(image, i) * exposure);
        bytes.insert(bytes.end(), {displayByte(color.x), displayByte(color.y), displayByte(color.z)});
    }
    return bytes;
}

void writeBytes(const std::string& path, const FloatImage& image, const std::vector<uint8_t>& bytes) {
    writeThenRename(path, [&](const std::string& partial) {
        std::ofstream file(partial, std::ios::binary);
        const auto append = [](void* stream, void* data, int size) {
            static_cast<std::ofstream*>(stream)->write(static_cast<const char*>(data), size);
        };
        const bool encoded = stbi_write_png_to_func(append, &file, static_cast<int>(image.width),
                                                    static_cast<int>(image.height), kChannels, bytes.data(),
                                                    static_cast<int>(image.width * kChannels)) != 0;
        file.close();
        if (!encoded || !file) throw std::runtime_error("no space or no permission");
    });
}

}   // namespace

float autoExposure(const FloatImage& image) {
    constexpr float kTarget = 0.14f, kBlack = 1e-3f;
    std::vector<float> lit;
    for (size_t i = 0; i < size_t{image.width} * image.height; ++i)
        if (const float value = shown::luminance(pixel(image, i)); value > 0) lit.push_back(value);
    if (lit.empty()) return 1;
    const auto bright = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() * 9 / 10);
    std::nth_element(lit.begin(), bright, lit.end());
    const float black = *bright * kBlack;
    std::erase_if(lit, [&](float value) { return value < black; });
    double sum = 0;
    for (const float value : lit) sum += std::log(value);
    return kTarget / static_cast<float>(std::exp(sum / static_cast<double>(lit.size())));
}

void writeExr(const std::string& path, const FloatImage& image) {
    checkShape(path, image);
    writeThenRename(path, [&](const std::string& partial) {
        Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
        for (const char* name : kChannelNames) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        // OpenEXR has one slice type for reading and writing; here it only reads.
        Imf::FrameBuffer buffer =
            interleaved(const_cast<float*>(image.rgb.data()), image.width, {0, 0}, false);
        if (!image.alpha.empty()) {
            header.channels().insert("A", Imf::Channel(Imf::FLOAT));
            char* alpha = reinterpret_cast<char*>(const_cast<float*>(image.alpha.data()));
            buffer.insert("A", Imf::Slice(Imf::FLOAT, alpha, sizeof(float), image.width * sizeof(float)));
        }
        Imf::OutputFile file(partial.c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(static_cast<int>(image.height));
    });
}

FloatImage readExr(const std::string& path) {
    try {
        Imf::InputFile file(path.c_str());
        return readPixels(file);
    } catch (const std::exception& exception) {
        throw std::runtime_error(path + ": cannot be read: " + exception.what());
    }
}

void writePng(const std::string& path, const FloatImage& image, float exposure) {
    checkShape(path, image);
    writeBytes(path, image, displayBytes(image, exposure > 0 ? exposure : autoExposure(image)));
}

void writeColorsPng(const std::string& path, const FloatImage& image) {
    checkShape(path, image);
    std::vector<uint8_t> bytes;
    for (const float value : image.rgb)
        bytes.push_back(static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255)));
    writeBytes(path, image, bytes);
}

}   // namespace samples
