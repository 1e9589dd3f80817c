// The passes compiled while the program runs: the same as those of the build, and every mistake with its file and line.
#include <restir/compiler.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <restir_embedded.h>

namespace {

namespace fs = std::filesystem;

// A bridge directory that is gone after the test.
class Bridge {
public:
    explicit Bridge(const std::string& text)
        : directory_((fs::temp_directory_path() / ("restir-bridge-" + std::to_string(std::random_device()()))).string()) {
        fs::create_directory(directory_);
        std::ofstream(file(), std::ios::binary) << text;
    }
    ~Bridge() { fs::remove_all(directory_); }
    Bridge(const Bridge&) = delete;
    Bridge& operator=(const Bridge&) = delete;
    const char* directory() const { return directory_.c_str(); }
    std::string file() const { return directory_ + "/restir_bridge.glsl"; }

private:
    std::string directory_;
};

class Compiler : public testing::Test {
protected:
    restir::CompileDesc desc(const char* bridge = nullptr) {
        return {.includeDirectory = RESTIR_INCLUDES,
                .shaderDirectory = RESTIR_SHADERS,
                .bridgeDirectory = bridge,
                .messages = {&said_, [](void* said, restir::Severity, const char* text) {
                                 *static_cast<std::string*>(said) += std::string(text) + '\n';
                             }}};
    }
    void expectError(const restir::CompileDesc& desc, const std::string& word) {
        said_.clear();
        const auto pack = restir::compilePasses(desc);
        ASSERT_FALSE(pack);
        EXPECT_EQ(pack.error().status, restir::Status::InvalidArgument);
        EXPECT_NE(said_.find(word), std::string::npos) << "said: " << said_ << "without " << word;
    }
    std::string said_;
};

class SameWords : public Compiler, public testing::WithParamInterface<const restir::ShaderPack*> {};

TEST_P(SameWords, AsTheBuild) {
    const restir::ShaderPack& embedded = *GetParam();
    restir::CompileDesc wanted = desc();
    wanted.rays = embedded.rays;
    const auto start = std::chrono::steady_clock::now();
    const auto compiled = restir::compilePasses(wanted);
    ASSERT_TRUE(compiled) << said_;
    RecordProperty("seconds", std::to_string(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()));
    EXPECT_EQ(said_, "");
    const restir::ShaderPack& pack = compiled->pack();
    EXPECT_EQ(pack.shaderAbi, uint32_t{RESTIR_SHADER_ABI});
    EXPECT_EQ(pack.rays, embedded.rays);
    ASSERT_EQ(pack.modules.size(), embedded.modules.size());
    for (const restir::ShaderPack::Module& built : embedded.modules) {
        const auto same = std::find_if(pack.modules.begin(), pack.modules.end(), [&](const restir::ShaderPack::Module& module) {
            return module.pass == std::string_view(built.pass);
        });
        ASSERT_NE(same, pack.modules.end()) << built.pass;
        EXPECT_TRUE(std::equal(built.words, built.words + built.wordCount, same->words, same->words + same->wordCount))
            << built.pass;
        EXPECT_EQ(same->traces, built.traces) << built.pass;
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, SameWords,
                         testing::Values(&kEmbeddedQueryPack, &kEmbeddedPipelinePack, &kEmbeddedSoftwarePack));

TEST_F(Compiler, HostsBridge) {
    const char* const shade[] = {"di.shade"};
    restir::CompileDesc with = desc(RESTIR_OWN_BRIDGE), without = desc();
    with.passes = without.passes = shade;
    const auto own = restir::compilePasses(with), standard = restir::compilePasses(without);
    ASSERT_TRUE(own && standard) << said_;
    ASSERT_EQ(own->pack().modules.size(), 1u);
    EXPECT_NE(own->pack().modules[0].wordCount, standard->pack().modules[0].wordCount);
}

TEST_F(Compiler, MistakesHaveFileAndLine) {
    const Bridge syntax("#include \"restir/bridge/standard.glsl\"\n\nfloat f() { return nonsense; }\n");
    expectError(desc(syntax.directory()), "restir: " + syntax.file() + ":3: 'nonsense'");
    const Bridge include("\n#include \"not_there.glsl\"\n");
    expectError(desc(include.directory()), include.file() + ":2: '#include'");
    EXPECT_NE(said_.find("not_there.glsl"), std::string::npos) << said_;
    const Bridge loop("#include \"restir_bridge.glsl\"\n");   // itself
    expectError(desc(loop.directory()), loop.file());
}

TEST_F(Compiler, WhatIsMissingIsNamed) {
    expectError(desc("/nowhere"), "CompileDesc::bridgeDirectory /nowhere has no restir_bridge.glsl");
    restir::CompileDesc wrong = desc();
    wrong.shaderDirectory = "/nowhere";
    expectError(wrong, "CompileDesc::shaderDirectory /nowhere");
    wrong = desc();
    wrong.includeDirectory = nullptr;
    expectError(wrong, "CompileDesc::includeDirectory is null");
    wrong = desc();
    const char* const pass[] = {"di.nonsense"};
    wrong.passes = pass;
    expectError(wrong, "CompileDesc::passes: di.nonsense");
}

TEST_F(Compiler, GarbageIsAMessage) {
    std::mt19937 random(1);
    std::string garbage(5000, ' ');
    for (char& byte : garbage) byte = char(random());
    for (const std::string& text : {garbage, std::string(), std::string("\0\0\0", 3), "#" + std::string(9000, '('),
                                    std::string("#line 7 \"elsewhere\"\n#error\n"), std::string("#define rsBridgeHit(\n")}) {
        const Bridge bridge(text);
        said_.clear();
        EXPECT_FALSE(restir::compilePasses(desc(bridge.directory())));
        EXPECT_NE(said_, "");
    }
}

}   // namespace
