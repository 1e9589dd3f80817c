// One target under libFuzzer. Directories among the arguments get the seeds first.
#include <filesystem>
#include <fstream>
#include <string>

#include "fuzz/target.h"

namespace {
constexpr const fuzz::Target& kTarget = fuzz::RESTIR_FUZZ_TARGET;
}

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    for (int i = 1; i < *count; ++i) {
        const std::filesystem::path directory = (*arguments)[i];
        if (!std::filesystem::is_directory(directory)) continue;
        size_t number = 0;
        for (const fuzz::Bytes& seed : kTarget.seeds())
            std::ofstream(directory / ("seed" + std::to_string(number++)), std::ios::binary)
                .write(reinterpret_cast<const char*>(seed.data()), std::streamsize(seed.size()));
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    kTarget.run({data, size});
    return 0;
}
