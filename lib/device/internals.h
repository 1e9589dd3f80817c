#pragma once

namespace restir {

// The SDK's own way into its public objects.
struct Internals {
    template <class Object>
    static const typename Object::Impl& of(const Object& object) noexcept {
        return *object.impl_;
    }
};

}   // namespace restir
