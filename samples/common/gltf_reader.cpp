#include "gltf_reader.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace samples::gltf {

namespace {

constexpr size_t kMaxElements = size_t{1} << 28;   // per accessor, 3 GiB of positions
// tinygltf walks `extras` and `extensions` recursively; deeper documents would overflow its stack.
constexpr int kMaxJsonDepth = 200;

std::vector<uint8_t> readFile(const std::string& path) {
    std::error_code error;
    const bool regular = std::filesystem::is_regular_file(path, error);
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (error || !regular || !file) throw std::runtime_error(path + ": cannot be opened");
    const std::streamoff size = file.tellg();
    if (size < 0 || size > std::numeric_limits<int32_t>::max())
        throw std::runtime_error(path + ": larger than 2 GiB");
    std::vector<uint8_t> bytes(static_cast<size_t>(size));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes.data()), size);
    if (!file) throw std::runtime_error(path + ": cannot be read");
    return bytes;
}

bool tooDeep(std::span<const uint8_t> json) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const uint8_t c = json[i];
        if (inString && c == '\\')
            ++i;
        else if (c == '"')
            inString = !inString;
        else if (!inString && (c == '{' || c == '['))
            ++depth;
        else if (!inString && (c == '}' || c == ']'))
            --depth;
        if (depth > kMaxJsonDepth) return true;
    }
    return false;
}

// Sizes that tinygltf would drop without a word; null if there are none.
const char* negativeSize(std::span<const uint8_t> json) {
    const std::string_view text(reinterpret_cast<const char*>(json.data()), json.size());
    for (const char* name : {"byteOffset", "byteLength", "byteStride", "count"}) {
        const std::string key = '"' + std::string(name) + '"';
        for (size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
            const size_t value = text.find_first_not_of(" \t\r\n:", at + key.size());
            if (value != std::string_view::npos && text[value] == '-') return name;
        }
    }
    return nullptr;
}

bool isBinary(std::span<const uint8_t> bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

std::span<const uint8_t> jsonPart(std::span<const uint8_t> bytes) {
    constexpr size_t kHeader = 20;   // file header, then the JSON chunk's length and type
    if (!isBinary(bytes) || bytes.size() < kHeader) return bytes;
    uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof(length));
    return bytes.subspan(kHeader, std::min<size_t>(length, bytes.size() - kHeader));
}

// Keeps the encoded bytes: decoding happens later, in parallel and only for images in use. Images in a
// buffer view are not touched here, since tinygltf has not checked that view's range.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    image->as_is = true;
    if (image->bufferView < 0) image->image.assign(bytes, bytes + std::max(size, 0));
    return true;
}

// Files beside the document, as the document itself is read: nothing but regular files of a sane size.
bool readBeside(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void*) {
    try {
        *bytes = readFile(path);
        return true;
    } catch (const std::runtime_error& exception) {
        *error += exception.what();
        return false;
    }
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

template <typename T>
float toFloat(const uint8_t* bytes, bool normalized) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    if constexpr (std::is_floating_point_v<T>) return static_cast<float>(value);
    if (!normalized) return static_cast<float>(value);
    return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

using ToFloat = float (*)(const uint8_t*, bool);

ToFloat floatConverter(int componentType) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return toFloat<int8_t>;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return toFloat<uint8_t>;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return toFloat<int16_t>;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return toFloat<uint16_t>;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return toFloat<uint32_t>;
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return toFloat<float>;
        default:
            return nullptr;
    }
}

size_t componentSize(int componentType) {
    const int32_t size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(componentType));
    return size > 0 ? static_cast<size_t>(size) : 0;
}

uint32_t loadIndex(const uint8_t* bytes, size_t size) {
    uint32_t value = 0;
    std::memcpy(&value, bytes, size);   // little-endian hosts only, as everything in this project
    return value;
}

bool isIndexType(int componentType) {
    return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}   // namespace

std::vector<uint8_t> Reader::uriBytes(const std::string& uri, const std::string& field) const {
    std::vector<unsigned char> bytes;
    std::string type;
    if (uri.starts_with("data:")) {
        // tinygltf knows the media types of buffers and images only.
        const size_t data = uri.find(";base64,");
        const std::string known =
            "data:application/octet-stream" + (data == std::string::npos ? "" : uri.substr(data));
        if (!tinygltf::DecodeDataURI(&bytes, type, known, 0, false))
            fail(field, "its data cannot be decoded");
        return bytes;
    }
    return readFile((std::filesystem::path(path_).parent_path() / uri).string());
}

struct Reader::Elements {
    const uint8_t* data = nullptr;   // null: all zeros
    size_t stride = 0, count = 0, componentSize = 0;
};

Reader::Reader(std::string path, std::vector<std::string>& warnings)
    : path_(std::move(path)), warnings_(warnings) {
    parse(readFile(path_));
}

void Reader::parse(const std::vector<uint8_t>& bytes) {
    if (tooDeep(jsonPart(bytes))) fail("document", "nested too deeply");
    if (const char* field = negativeSize(jsonPart(bytes))) fail(field, "is negative");
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keepEncoded, nullptr);
    loader.SetFsCallbacks({.FileExists = tinygltf::FileExists,
                           .ExpandFilePath = [](const std::string& path, void*) { return path; },
                           .ReadWholeFile = readBeside,
                           .WriteWholeFile = nullptr,
                           .user_data = nullptr});
    const std::string folder = std::filesystem::path(path_).parent_path().string();
    const auto size = static_cast<unsigned int>(bytes.size());
    std::string error, warning;
    bool read = false;
    try {
        read = isBinary(bytes)
                   ? loader.LoadBinaryFromMemory(&model_, &error, &warning, bytes.data(), size, folder)
                   : loader.LoadASCIIFromString(&model_, &error, &warning,
                                                reinterpret_cast<const char*>(bytes.data()), size, folder);
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!read) fail("document", error.empty() ? "not a glTF 2.0 file" : firstLine(error));
}

void Reader::fail(const std::string& field, const std::string& what) const {
    throw std::runtime_error(path_ + ": " + field + ": " + what);
}

void Reader::warn(const std::string& what) {
    const std::string line = path_ + ": " + what;
    if (std::find(warnings_.begin(), warnings_.end(), line) == warnings_.end()) warnings_.push_back(line);
}

size_t Reader::checkedIndex(int index, size_t count, const std::string& field) const {
    if (index < 0 || static_cast<size_t>(index) >= count)
        fail(field, "index " + std::to_string(index) + " of " + std::to_string(count));
    return static_cast<size_t>(index);
}

std::span<const uint8_t> Reader::viewBytes(int bufferView, const std::string& field) const {
    const auto& view = model_.bufferViews[checkedIndex(bufferView, model_.bufferViews.size(), field)];
    const std::string name = "bufferViews[" + std::to_string(bufferView) + "]";
    const auto& data =
        model_.buffers[checkedIndex(view.buffer, model_.buffers.size(), name + ".buffer")].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        fail(name, "reaches past the end of its buffer");
    return {data.data() + view.byteOffset, view.byteLength};
}

std::span<const uint8_t> Reader::imageBytes(size_t index) const {
    const auto& image = model_.images[index];
    const std::string field = "images[" + std::to_string(index) + "]";
    if (image.bufferView >= 0) return viewBytes(image.bufferView, field + ".bufferView");
    if (image.image.empty()) fail(field, "cannot be read: " + image.uri);
    return image.image;
}

size_t Reader::accessorCount(int accessor, const std::string& field) const {
    const size_t count = model_.accessors[checkedIndex(accessor, model_.accessors.size(), field)].count;
    if (count > kMaxElements) fail(field, "too many elements: " + std::to_string(count));
    return count;
}

Reader::Elements Reader::elementsOf(int index, int components, const std::string& field) const {
    Elements elements{.count = accessorCount(index, field)};
    const auto& accessor = model_.accessors[static_cast<size_t>(index)];
    const std::string name = field + " (accessors[" + std::to_string(index) + "])";
    elements.componentSize = componentSize(accessor.componentType);
    if (elements.componentSize == 0 || !floatConverter(accessor.componentType))
        fail(name, "unknown componentType " + std::to_string(accessor.componentType));
    if (tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)) != components)
        fail(name, "expected " + std::to_string(components) + " components");
    if (accessor.bufferView < 0) {
        // Nothing in the file backs these elements, so its size cannot bound them.
        constexpr size_t kMaxUnbacked = size_t{1} << 24;
        if (elements.count > kMaxUnbacked) fail(name, "too many elements without a bufferView");
        return elements;
    }
    const std::span<const uint8_t> bytes = viewBytes(accessor.bufferView, name + ".bufferView");
    const size_t elementSize = elements.componentSize * static_cast<size_t>(components);
    const size_t viewStride = model_.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
    elements.stride = viewStride ? viewStride : elementSize;
    if (elements.stride < elementSize || elements.stride > 4096) fail(name, "bad byteStride");
    if (elements.count == 0) return elements;
    const size_t needed = elements.stride * (elements.count - 1) + elementSize;
    if (accessor.byteOffset > bytes.size() || needed > bytes.size() - accessor.byteOffset)
        fail(name, "reaches past the end of its bufferView");
    elements.data = bytes.data() + accessor.byteOffset;
    return elements;
}

void Reader::readFloats(int index, int components, std::span<float> out, const std::string& field) const {
    const Elements elements = elementsOf(index, components, field);
    const auto& accessor = model_.accessors[static_cast<size_t>(index)];
    const size_t width = static_cast<size_t>(components);
    const bool packed =
        accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && elements.stride == width * sizeof(float);
    if (!elements.data) {
        std::fill(out.begin(), out.end(), 0.0f);
    } else if (packed) {
        std::memcpy(out.data(), elements.data, out.size_bytes());
    } else {
        const ToFloat convert = floatConverter(accessor.componentType);
        for (size_t i = 0; i < elements.count; ++i)
            for (size_t c = 0; c < width; ++c)
                out[i * width + c] = convert(elements.data + i * elements.stride + c * elements.componentSize,
                                             accessor.normalized);
    }
    if (accessor.sparse.isSparse) applySparse(accessor, out, field);
}

void Reader::applySparse(const tinygltf::Accessor& accessor, std::span<float> out,
                         const std::string& field) const {
    const auto& sparse = accessor.sparse;
    const std::string name = field + ".sparse";
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        fail(name, "negative count or offset");
    if (!isIndexType(sparse.indices.componentType)) fail(name, "bad index componentType");
    const size_t count = static_cast<size_t>(sparse.count);
    const size_t indexSize = componentSize(sparse.indices.componentType);
    const size_t valueSize = componentSize(accessor.componentType);
    const size_t width = out.size() / std::max<size_t>(accessor.count, 1);
    const auto indices = viewBytes(sparse.indices.bufferView, name + ".indices");
    const auto values = viewBytes(sparse.values.bufferView, name + ".values");
    const size_t indexStart = static_cast<size_t>(sparse.indices.byteOffset);
    const size_t valueStart = static_cast<size_t>(sparse.values.byteOffset);
    if (indexStart + count * indexSize > indices.size() ||
        valueStart + count * valueSize * width > values.size())
        fail(name, "reaches past the end of its bufferView");
    const ToFloat convert = floatConverter(accessor.componentType);
    for (size_t i = 0; i < count; ++i) {
        const size_t element = loadIndex(indices.data() + indexStart + i * indexSize, indexSize);
        if (element >= accessor.count) fail(name, "index " + std::to_string(element) + " out of range");
        for (size_t c = 0; c < width; ++c)
            out[element * width + c] =
                convert(values.data() + valueStart + (i * width + c) * valueSize, accessor.normalized);
    }
}

std::vector<uint32_t> Reader::readIndices(int index, const std::string& field) const {
    const Elements elements = elementsOf(index, 1, field);
    const auto& accessor = model_.accessors[static_cast<size_t>(index)];
    if (!isIndexType(accessor.componentType)) fail(field, "indices must be unsigned integers");
    if (accessor.sparse.isSparse) fail(field, "sparse indices are not supported");
    std::vector<uint32_t> indices(elements.count);
    if (!elements.data) return indices;
    for (size_t i = 0; i < elements.count; ++i)
        indices[i] = loadIndex(elements.data + i * elements.stride, elements.componentSize);
    return indices;
}

}   // namespace samples::gltf
