// The same bits whatever the driver does with its threads and vectors. Its environment is read once, so each
// picture is a process of its own.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace tests {
namespace {

// The file that restir-render writes in `environment`.
std::string pictureBytes(const std::string& environment, const std::string& settings) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                       ("restir_" + std::to_string(std::random_device{}()) + ".exr");
    const std::string command =
        environment + " '" RESTIR_RENDER "' builtin:cornell --size 64x40 --frames 3 --move 3 --quiet " +
        settings + " --out '" + file.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    std::filesystem::remove(file);
    EXPECT_GT(bytes.size(), 64u * 40u) << command;
    return bytes;
}

// The boiling filter is what workgroups share memory for.
constexpr const char* kSeveralPasses = "--spatial-passes 3 --radius 12 --boiling-filter 1";

TEST(Determinism, NumberOfThreads) {
    for (const char* settings : {"", kSeveralPasses, "--weights balance --visibility none --lights gpu --animate lights"}) {
        SCOPED_TRACE(settings);
        EXPECT_EQ(pictureBytes("LP_NUM_THREADS=1", settings), pictureBytes("LP_NUM_THREADS=2", settings));
    }
}

// Vectors of 128 bits are subgroups of 4, of 256 bits of 8. Mesa's cache does not tell them apart, so it is
// off, and the optimiser with it, for the sake of time.
TEST(Determinism, SubgroupSize) {
    const std::string environment =
        "MESA_SHADER_CACHE_DISABLE=true GALLIVM_PERF=nopt LP_NATIVE_VECTOR_WIDTH=";
    EXPECT_EQ(pictureBytes(environment + "128", kSeveralPasses),
              pictureBytes(environment + "256", kSeveralPasses));
}

}   // namespace
}   // namespace tests
