#include <restir/device.h>

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace {

using restir::DeviceNeeds;

DeviceNeeds needs() { return restir::deviceNeeds(restir::RayBackend::RayQuery); }

TEST(DeviceNeeds, ChainsEveryStructOnce) {
    DeviceNeeds wanted = needs();
    std::multiset<VkStructureType> types;
    const auto* link = reinterpret_cast<const VkBaseInStructure*>(wanted.chain());
    for (int i = 0; link && i < 20; ++i, link = link->pNext) types.insert(link->sType);
    const std::multiset<VkStructureType> all{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR,
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
    EXPECT_EQ(types, all);
}

TEST(DeviceNeeds, ChainCarriesTheHostsAdditions) {
    DeviceNeeds wanted = needs();
    wanted.core.samplerAnisotropy = VK_TRUE;
    EXPECT_TRUE(wanted.chain()->features.samplerAnisotropy);
    EXPECT_TRUE(wanted.chain()->features.shaderStorageImageWriteWithoutFormat);
}

TEST(DeviceNeeds, ACopyChainsItself) {
    DeviceNeeds first = needs();
    (void)first.chain();
    DeviceNeeds copy = first;
    const auto* link = reinterpret_cast<const VkBaseInStructure*>(copy.chain());
    const auto begin = reinterpret_cast<uintptr_t>(&copy), end = begin + sizeof copy;
    for (; link; link = link->pNext) {
        EXPECT_GE(reinterpret_cast<uintptr_t>(link), begin);
        EXPECT_LT(reinterpret_cast<uintptr_t>(link), end);
    }
}

TEST(DeviceNeeds, NamesRayQuery) {
    const DeviceNeeds wanted = needs();
    const std::set<std::string> names(wanted.extensions.begin(), wanted.extensions.end());
    EXPECT_TRUE(names.contains(VK_KHR_RAY_QUERY_EXTENSION_NAME));
    EXPECT_TRUE(names.contains(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME));
    EXPECT_TRUE(names.contains(VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME));
}

TEST(DeviceNeeds, PipelinesNeedNoRayQuery) {
    DeviceNeeds wanted = restir::deviceNeeds(restir::RayBackend::Pipeline);
    const std::set<std::string> names(wanted.extensions.begin(), wanted.extensions.end());
    EXPECT_TRUE(names.contains(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME));
    EXPECT_TRUE(names.contains(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME));
    EXPECT_FALSE(names.contains(VK_KHR_RAY_QUERY_EXTENSION_NAME));
    std::multiset<VkStructureType> types;
    const auto* link = reinterpret_cast<const VkBaseInStructure*>(wanted.chain());
    for (; link; link = link->pNext) types.insert(link->sType);
    EXPECT_EQ(types.count(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR), 1u);
    EXPECT_EQ(types.count(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR), 0u);
}

TEST(DeviceNeeds, SoftwareRaysNeedNoExtension) {
    for (restir::RayBackend rays : {restir::RayBackend::Software, restir::RayBackend::Own}) {
        DeviceNeeds wanted = restir::deviceNeeds(rays);
        EXPECT_TRUE(wanted.extensions.empty());
        EXPECT_FALSE(wanted.accelerationStructure.accelerationStructure);
        EXPECT_FALSE(wanted.rayQuery.rayQuery);
        const auto* link = reinterpret_cast<const VkBaseInStructure*>(wanted.chain());
        int structs = 0;
        for (; link; link = link->pNext) ++structs;
        EXPECT_EQ(structs, 3);
        // What the host turns on besides comes along.
        wanted.rayQuery.rayQuery = VK_TRUE;
        structs = 0;
        for (link = reinterpret_cast<const VkBaseInStructure*>(wanted.chain()); link; link = link->pNext) ++structs;
        EXPECT_EQ(structs, 4);
    }
}

TEST(CheckDevice, NamesWhatIsNull) {
    std::string said;
    restir::DeviceInfo info;
    info.messages = {&said, [](void* user, restir::Severity, const char* text) {
                         *static_cast<std::string*>(user) = text;
                     }};
    EXPECT_EQ(restir::checkDevice(info, restir::RayBackend::RayQuery), restir::Status::InvalidArgument);
    EXPECT_NE(said.find("getInstanceProcAddr"), std::string::npos) << said;
    info.getInstanceProcAddr = [](VkInstance, const char*) -> PFN_vkVoidFunction { return nullptr; };
    EXPECT_EQ(restir::checkDevice(info, restir::RayBackend::RayQuery), restir::Status::InvalidArgument);
    EXPECT_NE(said.find("DeviceInfo::instance"), std::string::npos) << said;
}

}   // namespace
