// What the passes take of a GPU that is not here: RADV compiles them for any family without a device, and
// tells registers, spills and code size. A pass that spills fails, and one that has grown beyond the margins
// over the baseline. Ray tracing pipelines have at most 128 vector registers there, so the larger ones do spill: they
// fail where they take more scratch memory than the baseline.
//
//   budget FAMILY BASELINE.txt [--write]      exit status 77: this machine cannot tell
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include <restir/context.h>
#include <restir_embedded.h>

namespace {

constexpr int kSkipped = 77;
constexpr double kCodeMargin = 1.15;      // times the baseline's bytes
constexpr double kScratchMargin = 1.15;   // the same, of ray tracing pipelines
// These go to lanes of a vector register, 32 or 64 to each, not to memory.
constexpr uint64_t kScalarSpills = 11;
constexpr uint64_t kSoftwareScalarSpills = 38;   // five more buffers, held in scalar registers all along a walk
constexpr uint64_t kRegisterMargin = 8;   // vector registers, what RDNA allocates at a time

[[noreturn]] void skip(const std::string& why) {
    std::printf("skipped: %s\n", why.c_str());
    std::exit(kSkipped);
}
void check(VkResult result, const char* what) {
    if (result == VK_SUCCESS) return;
    std::printf("%s failed: VkResult %d\n", what, int(result));
    std::exit(1);
}

using Statistics = std::map<std::string, unsigned long long>;
std::vector<std::pair<std::string, Statistics>> compiled;   // by pass

struct Gpu {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::string name, driver;
};
Gpu gpu;

std::string findDriver() {
    for (const char* directory : {"/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
        std::error_code error;
        for (const auto& entry : std::filesystem::directory_iterator(directory, error))
            if (entry.path().filename().string().starts_with("radeon_icd")) return entry.path();
    }
    skip("Mesa's RADV is not installed");
}

bool hasExtension(const char* name) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(gpu.physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> all(count);
    vkEnumerateDeviceExtensionProperties(gpu.physical, nullptr, &count, all.data());
    for (const auto& extension : all)
        if (!std::strcmp(extension.extensionName, name)) return true;
    return false;
}

void makeInstance(const char* family) {
    const std::string driver = findDriver();
    for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) setenv(name, driver.c_str(), 1);
    setenv("RADV_FORCE_FAMILY", family, 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);   // a cached pipeline has no statistics
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pApplicationInfo = &application};
    if (vkCreateInstance(&info, nullptr, &gpu.instance) != VK_SUCCESS) skip("this RADV does not start");
    uint32_t count = 1;
    vkEnumeratePhysicalDevices(gpu.instance, &count, &gpu.physical);
    if (count == 0) skip(std::string("this RADV knows no ") + family);
    VkPhysicalDeviceDriverProperties properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 both{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                     .pNext = &properties};
    vkGetPhysicalDeviceProperties2(gpu.physical, &both);
    gpu.name = both.properties.deviceName;
    gpu.driver = properties.driverInfo;
}

void makeDevice(restir::RayBackend rays) {
    restir::DeviceNeeds needs = restir::deviceNeeds(rays);
    std::vector<const char*> extensions(needs.extensions.begin(), needs.extensions.end());
    extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    for (const char* extension : extensions)
        if (!hasExtension(extension)) skip(std::string("this RADV has no ") + extension + " for " + gpu.name);
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR executable{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR,
        .pNext = const_cast<VkPhysicalDeviceFeatures2*>(needs.chain()),
        .pipelineExecutableInfo = VK_TRUE};
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &executable,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = uint32_t(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
    check(vkCreateDevice(gpu.physical, &info, nullptr, &gpu.device), "vkCreateDevice");
}

template <class Function>
Function deviceFunctionOf(const char* name) {
    return reinterpret_cast<Function>(vkGetDeviceProcAddr(gpu.device, name));
}

Statistics statisticsOf(VkPipeline pipeline, uint32_t executable) {
    const auto query = deviceFunctionOf<PFN_vkGetPipelineExecutableStatisticsKHR>("vkGetPipelineExecutableStatisticsKHR");
    const VkPipelineExecutableInfoKHR info{.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR,
                                           .pipeline = pipeline,
                                           .executableIndex = executable};
    uint32_t count = 0;
    query(gpu.device, &info, &count, nullptr);
    std::vector<VkPipelineExecutableStatisticKHR> all(
        count, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
    query(gpu.device, &info, &count, all.data());
    Statistics result;
    for (const auto& statistic : all)
        if (statistic.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR)
            result[statistic.name] = statistic.value.u64;
    return result;
}

// A ray tracing pipeline is several programs, of which a wave runs one after the other: what the greediest of
// them takes, and the code of all.
Statistics statisticsOf(VkPipeline pipeline) {
    const auto query = deviceFunctionOf<PFN_vkGetPipelineExecutablePropertiesKHR>("vkGetPipelineExecutablePropertiesKHR");
    const VkPipelineInfoKHR info{.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, .pipeline = pipeline};
    uint32_t count = 0;
    query(gpu.device, &info, &count, nullptr);
    Statistics result;
    for (uint32_t i = 0; i < count; ++i)
        for (const auto& [name, value] : statisticsOf(pipeline, i)) {
            const auto [found, isNew] = result.insert({name, value});
            if (isNew) continue;
            auto& all = found->second;
            all = name == "Code size"            ? all + value
                  : name == "Subgroups per SIMD" ? std::min(all, value)
                                                 : std::max(all, value);
        }
    return result;
}

// ---- the SDK's way to the driver: its own layouts and pipelines, asked for their statistics ------

std::map<VkShaderModule, const uint32_t*> wordsOf;
const restir::ShaderPack* pack = nullptr;   // whose pipelines are being made

// Of the pack's pass; empty: another pack's has been compiled, and does not trace.
std::string nameOf(VkShaderModule shader) {
    const uint32_t* words = wordsOf.at(shader);
    for (const restir::ShaderPack::Module& module : kEmbeddedQueryPack.modules)
        if (module.words == words) return pack == &kEmbeddedQueryPack ? module.pass : "";
    for (const restir::ShaderPack::Module& module : pack->modules)
        if (module.words == words)
            return std::string(module.pass) +
                   (pack->rays == restir::RayBackend::Pipeline ? "@pipeline" : "@software");
    return "";
}
void note(VkShaderModule shader, VkPipeline pipeline) {
    const std::string name = nameOf(shader);
    if (!name.empty()) compiled.push_back({name, statisticsOf(pipeline)});
}

VKAPI_ATTR VkResult VKAPI_CALL createModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkShaderModule* module) {
    const VkResult result = vkCreateShaderModule(device, info, allocator, module);
    if (result == VK_SUCCESS) wordsOf[*module] = info->pCode;
    return result;
}
VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache, uint32_t,
                                               const VkComputePipelineCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkPipeline* pipeline) {
    VkComputePipelineCreateInfo asked = *info;
    asked.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    const VkResult result = vkCreateComputePipelines(device, cache, 1, &asked, allocator, pipeline);
    if (result == VK_SUCCESS) note(info->stage.module, *pipeline);
    return result;
}
VKAPI_ATTR VkResult VKAPI_CALL createRayPipelines(VkDevice device, VkDeferredOperationKHR operation, VkPipelineCache cache,
                                                  uint32_t, const VkRayTracingPipelineCreateInfoKHR* info,
                                                  const VkAllocationCallbacks* allocator, VkPipeline* pipeline) {
    VkRayTracingPipelineCreateInfoKHR asked = *info;
    asked.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    const VkResult result = deviceFunctionOf<PFN_vkCreateRayTracingPipelinesKHR>("vkCreateRayTracingPipelinesKHR")(
        device, operation, cache, 1, &asked, allocator, pipeline);
    if (result == VK_SUCCESS) note(info->pStages[0].module, *pipeline);
    return result;
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceFunction(VkDevice device, const char* name) {
    if (!std::strcmp(name, "vkCreateShaderModule")) return reinterpret_cast<PFN_vkVoidFunction>(createModule);
    if (!std::strcmp(name, "vkCreateComputePipelines"))
        return reinterpret_cast<PFN_vkVoidFunction>(createPipelines);
    if (!std::strcmp(name, "vkCreateRayTracingPipelinesKHR"))
        return reinterpret_cast<PFN_vkVoidFunction>(createRayPipelines);
    return vkGetDeviceProcAddr(device, name);
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceFunction(VkInstance instance, const char* name) {
    if (!std::strcmp(name, "vkGetDeviceProcAddr"))
        return reinterpret_cast<PFN_vkVoidFunction>(deviceFunction);
    return vkGetInstanceProcAddr(instance, name);
}

void compilePasses(const restir::ShaderPack& passes) {
    makeDevice(passes.rays);
    pack = &passes;
    {
        const auto context = restir::Context::create({.device = {.getInstanceProcAddr = instanceFunction,
                                                                 .instance = gpu.instance,
                                                                 .physicalDevice = gpu.physical,
                                                                 .device = gpu.device},
                                                      .rays = passes.rays,
                                                      .shaders = &passes});
        // Nothing has memory here; the binding table, which asks for some, is made after all pipelines.
        if (!context && context.error().status != restir::Status::OutOfDeviceMemory) {
            std::printf("%s\n", context.error().what);
            std::exit(1);
        }
    }
    vkDestroyDevice(gpu.device, nullptr);
}

// ---- the budget ---------------------------------------------------------------------------------

struct Row {
    uint64_t registers = 0, waves = 0, code = 0, scratch = 0;
};
Row rowOf(const Statistics& s) {
    return {s.at("VGPRs"), s.at("Subgroups per SIMD"), s.at("Code size"), s.at("Scratch size")};
}

void print() {
    std::printf("%s, %s\n%-28s %8s %8s %8s %8s %8s %8s\n", gpu.name.c_str(), gpu.driver.c_str(), "pass",
                "VGPRs", "spilled", "scratch", "LDS", "waves", "code");
    for (const auto& [pass, s] : compiled)
        std::printf("%-28s %8llu %8llu %8llu %8llu %8llu %8llu\n", pass.c_str(), s.at("VGPRs"),
                    s.at("Spilled VGPRs") + s.at("Spilled SGPRs"), s.at("Scratch size"), s.at("LDS size"),
                    s.at("Subgroups per SIMD"), s.at("Code size"));
}

void write(const char* path) {
    std::ofstream file(path);
    file << gpu.driver << "\n";
    for (const auto& [pass, s] : compiled) {
        const Row row = rowOf(s);
        file << pass << " " << row.registers << " " << row.waves << " " << row.code << " " << row.scratch << "\n";
    }
}

// Another compiler is another budget: its driver is written first.
std::map<std::string, Row> read(const char* path) {
    std::ifstream file(path);
    std::string driver;
    std::getline(file, driver);
    std::map<std::string, Row> rows;
    if (driver != gpu.driver) {
        std::printf("the baseline is of %s: only spills count\n", driver.c_str());
        return rows;
    }
    std::string pass;
    for (Row row; file >> pass >> row.registers >> row.waves >> row.code >> row.scratch;) rows[pass] = row;
    return rows;
}

int judge(const std::map<std::string, Row>& baseline) {
    int failures = 0;
    const auto fail = [&](const std::string& pass, const char* what, uint64_t now, uint64_t then) {
        ++failures;
        std::printf("%s: %s %llu, the baseline is %llu\n", pass.c_str(), what,
                    static_cast<unsigned long long>(now), static_cast<unsigned long long>(then));
    };
    for (const auto& [pass, s] : compiled) {
        const bool isPipeline = pass.ends_with("@pipeline");
        if (!isPipeline) {
            for (const char* spill : {"Spilled VGPRs", "Scratch size"})
                if (s.at(spill) > 0) fail(pass, spill, s.at(spill), 0);
            const uint64_t scalars = pass.ends_with("@software") ? kSoftwareScalarSpills : kScalarSpills;
            if (s.at("Spilled SGPRs") > scalars) fail(pass, "Spilled SGPRs", s.at("Spilled SGPRs"), scalars);
        }
        const auto found = baseline.find(pass);
        if (found == baseline.end()) {
            if (!baseline.empty()) fail(pass, "is not in the baseline: make it again with --write;", 0, 0);
            continue;
        }
        const Row now = rowOf(s), then = found->second;
        if (now.registers > then.registers + kRegisterMargin)
            fail(pass, "VGPRs", now.registers, then.registers);
        if (double(now.code) > kCodeMargin * double(then.code))
            fail(pass, "bytes of code", now.code, then.code);
        if (isPipeline && double(now.scratch) > kScratchMargin * double(then.scratch))
            fail(pass, "scratch bytes a wave", now.scratch, then.scratch);
    }
    for (const auto& [pass, row] : baseline) {
        const auto isIt = [&pass = pass](const auto& now) { return now.first == pass; };
        if (std::none_of(compiled.begin(), compiled.end(), isIt)) fail(pass, "was not compiled; waves", 0, row.waves);
    }
    return failures;
}

}   // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    makeInstance(argv[1]);
    for (const restir::ShaderPack* passes : {&kEmbeddedQueryPack, &kEmbeddedPipelinePack, &kEmbeddedSoftwarePack})
        compilePasses(*passes);
    print();
    if (argc > 3) {
        write(argv[2]);
        return 0;
    }
    return judge(read(argv[2])) == 0 ? 0 : 1;
}
