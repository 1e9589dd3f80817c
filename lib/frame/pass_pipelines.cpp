#include <frame/pass_pipelines.h>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace restir {
namespace {

const ShaderPack::Module* findModule(const ShaderPack& pack, const char* pass) noexcept {
    for (const ShaderPack::Module& module : pack.modules)
        if (!std::strcmp(module.pass, pass)) return &module;
    return nullptr;
}

bool isOf(const char* room, const char* pass) noexcept { return !std::strncmp(pass, room, std::strlen(room)); }

VkResult makeComputePipeline(const Device& device, VkPipelineLayout layout, const ShaderPack::Module& module,
                             VkPipeline& pipeline) noexcept {
    const Functions& f = device.functions;
    VkShaderModule shader = VK_NULL_HANDLE;
    if (VkResult vk = makeModule(device, module, shader); vk != VK_SUCCESS) return vk;
    const VkComputePipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                           .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                     .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                     .module = shader,
                                                     .pName = "main"},
                                           .layout = layout};
    const VkResult vk = orNull(f.vkCreateComputePipelines(device.info.device, device.info.pipelineCache, 1, &info,
                                                          device.allocator(), &pipeline),
                               pipeline);
    f.vkDestroyShaderModule(device.info.device, shader, device.allocator());
    return vk;
}

Error lacking(const MessageSink& sink, const char* pass) noexcept {
    report(sink, Severity::Error, "restir: ContextDesc::shaders lacks the pass %s", pass);
    return {Status::ShaderMismatch, VK_SUCCESS, "ContextDesc::shaders lacks a pass"};
}

}   // namespace

PassPipelines::~PassPipelines() {
    for (const Entry& entry : entries_)
        if (entry.pipeline)
            device_->functions.vkDestroyPipeline(device_->info.device, entry.pipeline, device_->allocator());
}

Result<bool> PassPipelines::create(const Device& device, const Layouts& layouts, const ShaderPack& pack,
                                   PipelineCreation when) noexcept {
    device_ = &device;
    layouts_ = layouts;
    pack_ = pack;
    when_ = when;
    const MessageSink& sink = device.sink();
    const bool stages = pack.rays == RayBackend::Pipeline;
    for (auto [name, module] : {std::pair("rays.miss", &stages_.miss), std::pair("rays.closest_hit", &stages_.closestHit),
                                std::pair("rays.any_hit", &stages_.anyHit)})
        if (*module = findModule(pack, name); stages && !*module) return lacking(sink, name);
    int traced = 0;
    for (Entry& entry : entries_) {
        const ShaderPack::Module* module = findModule(pack, entry.pass);
        if (!module) return lacking(sink, entry.pass);
        if (stages && module->traces) entry.traced = traced++;
    }
    if (when == PipelineCreation::OnDemand) return stages ? makeTable(traced) : true;
    for (Entry& entry : entries_)
        if (auto made = make(entry); !made) return made;
    if (!stages) return true;
    if (auto made = makeTable(traced); !made) return made;
    for (const Entry& entry : entries_)
        if (auto written = writeTable(entry, entry.pipeline); !written) return written;
    return true;
}

Result<bool> PassPipelines::require(const char* pass) const noexcept {
    if (when_ == PipelineCreation::All) return true;
    Entry& entry = entries_[size_t(&of(pass) - entries_.data())];
    if (entry.pipeline.load(std::memory_order_acquire)) return true;
    const std::lock_guard lock(entry.making);
    return entry.pipeline ? true : make(entry);
}

// With its record where there is a table already.
Result<bool> PassPipelines::make(Entry& entry) const noexcept {
    const ShaderPack::Module& module = *findModule(pack_, entry.pass);
    const VkPipelineLayout layout = isOf("lights.", entry.pass) ? layouts_.lights : layouts_.frame;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult vk = entry.traced < 0 ? makeComputePipeline(*device_, layout, module, pipeline)
                                         : makeRayPipeline(*device_, layout, module, stages_, pipeline);
    if (vk != VK_SUCCESS) {
        report(device_->sink(), Severity::Error, "restir: creating the pipeline of %s failed", entry.pass);
        return failure(device_->sink(), Status::DeviceError, "creating a pipeline failed", vk);
    }
    device_->name(VK_OBJECT_TYPE_PIPELINE, handleValue(pipeline), entry.pass);
    if (when_ == PipelineCreation::OnDemand)
        if (auto written = writeTable(entry, pipeline); !written) {
            device_->functions.vkDestroyPipeline(device_->info.device, pipeline, device_->allocator());
            return written;
        }
    entry.pipeline.store(pipeline, std::memory_order_release);
    return true;
}

Result<bool> PassPipelines::makeTable(int pipelines) noexcept {
    auto table = BindingTable::create(*device_, uint32_t(pipelines));
    if (!table) return table.error();
    table_ = std::move(*table);
    return true;
}

Result<bool> PassPipelines::writeTable(const Entry& entry, VkPipeline pipeline) const noexcept {
    if (entry.traced < 0) return true;
    const VkResult vk = table_.set(*device_, uint32_t(entry.traced), pipeline);
    if (vk == VK_SUCCESS) return true;
    return failure(device_->sink(), Status::DeviceError, "reading a shader group's handle failed", vk);
}

const PassPipelines::Entry& PassPipelines::of(const char* pass) const noexcept {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return !std::strcmp(entry.pass, pass); });
    assert(found != entries_.end());
    return *found;
}

}   // namespace restir
