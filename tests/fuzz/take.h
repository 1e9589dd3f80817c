// Values made of bytes; zeros once there are no more.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <span>
#include <type_traits>

namespace fuzz {

class Take {
public:
    explicit Take(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    bool empty() const { return bytes_.empty(); }
    template <class T>
    T value() {
        T result{};
        const size_t size = std::min(sizeof(T), bytes_.size());
        std::memcpy(&result, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
        return result;
    }
    uint32_t below(uint32_t end) { return value<uint8_t>() % end; }
    bool flag() { return (value<uint8_t>() & 1) != 0; }
    template <class T>
    void set(T& field) {
        if constexpr (std::is_same_v<T, bool>)
            field = flag();
        else if constexpr (std::is_floating_point_v<T>)
            field = number();
        else if constexpr (std::is_integral_v<T> && sizeof(T) > 1)
            field = integer<T>(field);
        else
            field = value<T>();
    }
    template <class T, size_t N>
    void set(T (&fields)[N]) {
        for (T& field : fields) set(field);
    }
    // Each of them or, more often, what it was.
    template <class... T>
    void maybe(T&... fields) {
        (change(fields), ...);
    }

private:
    template <class T>
    void change(T& field) {
        if (value<uint8_t>() >= 0xe0) set(field);
    }
    // Most of what is done wrong is done near a limit.
    float number() {
        using Limits = std::numeric_limits<float>;
        constexpr float kEdges[] = {0,
                                    1,
                                    -1,
                                    0.5f,
                                    1e-38f,
                                    1e30f,
                                    -1e30f,
                                    1e9f,
                                    Limits::max(),
                                    Limits::lowest(),
                                    Limits::denorm_min(),
                                    Limits::infinity(),
                                    -Limits::infinity(),
                                    Limits::quiet_NaN(),
                                    1.5707964f,
                                    1000};
        const uint8_t choice = value<uint8_t>();
        return choice < std::size(kEdges) ? kEdges[choice] : value<float>();
    }
    template <class T>
    T integer(T before) {
        switch (value<uint8_t>() & 7) {
            case 0:
                return T(std::make_unsigned_t<T>(before) + 1u);
            case 1:
                return T(std::make_unsigned_t<T>(before) - 1u);
            case 2:
                return std::numeric_limits<T>::max();
            case 3:
                return 0;
            case 4:
                return value<T>();
            default:
                return T(value<uint8_t>());
        }
    }

    std::span<const uint8_t> bytes_;
};

}   // namespace fuzz
