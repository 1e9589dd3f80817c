#include <frame/descriptors.h>

#include <device/internals.h>
#include <frame/layouts.h>
#include <lights/table_impl.h>
#include <rays/bvh_impl.h>

namespace restir {
namespace {

// Collects writes to one set; storage for what they point at lives here.
class Writer {
public:
    explicit Writer(VkDescriptorSet set) noexcept : set_(set) {}

    void buffer(uint32_t binding, VkBuffer buffer, uint32_t element = 0) noexcept {
        buffers_[count_] = {buffer, 0, VK_WHOLE_SIZE};
        add(binding, element).pBufferInfo = &buffers_[count_];
        ++count_;
    }
    void image(uint32_t binding, VkImageView view, VkImageLayout layout) noexcept {
        if (!view) return;
        images_[count_] = {VK_NULL_HANDLE, view, layout};
        add(binding, 0).pImageInfo = &images_[count_];
        ++count_;
    }
    void accelerationStructure(uint32_t binding, const VkAccelerationStructureKHR& structure) noexcept {
        structures_[count_] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR,
                               .accelerationStructureCount = 1,
                               .pAccelerationStructures = &structure};
        add(binding, 0).pNext = &structures_[count_];
        ++count_;
    }
    void flush(const Device& device) const noexcept {
        device.functions.vkUpdateDescriptorSets(device.info.device, count_, writes_, 0, nullptr);
    }

private:
    VkWriteDescriptorSet& add(uint32_t binding, uint32_t element) noexcept {
        writes_[count_] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                           .dstSet = set_,
                           .dstBinding = binding,
                           .dstArrayElement = element,
                           .descriptorCount = 1,
                           .descriptorType = bindingType(binding)};
        return writes_[count_];
    }

    static constexpr uint32_t kMax =
        RS_BIND_COUNT + 2 * RS_GI_STREAMS + 2;   // the reservoirs are two, those of indirect light so many, corners of a Bvh three
    VkDescriptorSet set_;
    uint32_t count_ = 0;
    VkWriteDescriptorSet writes_[kMax];
    VkDescriptorBufferInfo buffers_[kMax];
    VkDescriptorImageInfo images_[kMax];
    VkWriteDescriptorSetAccelerationStructureKHR structures_[kMax];
};

// What the backend traces in.
void writeStructure(Writer& w, RayBackend rays, const FrameInput& frame) noexcept {
    if (tracesStructures(rays)) {
        w.accelerationStructure(RS_BIND_TLAS, frame.tlas);
        w.accelerationStructure(RS_BIND_PREVIOUS_TLAS, frame.previousTlas ? frame.previousTlas : frame.tlas);
    }
    if (rays == RayBackend::Software) {
        const Bvh::Impl& bvh = Internals::of(*frame.bvh);
        w.buffer(RS_BIND_BVH_NODES, bvh.buffer(BvhBuffer::Nodes));
        w.buffer(RS_BIND_BVH_CORNERS, bvh.buffer(BvhBuffer::Corners0), 0);
        w.buffer(RS_BIND_BVH_CORNERS, bvh.buffer(BvhBuffer::Corners1), 1);
        w.buffer(RS_BIND_BVH_CORNERS, bvh.buffer(BvhBuffer::Corners2), 2);
        w.buffer(RS_BIND_BVH_INSTANCES, bvh.buffer(BvhBuffer::Instances));
    }
}

}   // namespace

void writeDescriptors(const Session::Impl& s, const FrameInput& frame, uint32_t surfaces,
                      VkBuffer previousLights) noexcept {
    using enum SessionBuffer;
    const LightTable::Impl& lights = Internals::of(*frame.lights);
    Writer w(s.sets[frame.frameSlot]);
    w.buffer(RS_BIND_FRAME, s.buffers.buffer(s.constantsOf(frame.frameSlot)));
    w.buffer(RS_BIND_SURFACES, s.buffer(Surfaces0, surfaces));
    w.buffer(RS_BIND_SURFACES_MORE, s.buffer(More0, surfaces));
    w.buffer(RS_BIND_SURFACES_FRAME, s.buffer(SurfacesFrame));
    w.buffer(RS_BIND_PREVIOUS_SURFACES, s.buffer(Surfaces0, 1 - surfaces));
    w.buffer(RS_BIND_PREVIOUS_MORE, s.buffer(More0, 1 - surfaces));
    w.buffer(RS_BIND_RESERVOIRS, s.buffer(Reservoirs0), 0);
    w.buffer(RS_BIND_RESERVOIRS, s.buffer(Reservoirs1), 1);
    w.buffer(RS_BIND_LIGHTS, lights.current());
    w.buffer(RS_BIND_PREVIOUS_LIGHTS, previousLights);
    w.buffer(RS_BIND_ALIAS, lights.alias());
    if (lights.hasTree) w.buffer(RS_BIND_LIGHT_TREE, lights.buffer(TableBuffer::Tree));
    writeStructure(w, s.context->rays, frame);
    w.buffer(RS_BIND_COUNTERS, s.buffer(Counters));
    w.buffer(RS_BIND_RAY_LOG, s.buffer(RayLog));
    w.buffer(RS_BIND_NOTES, s.buffer(Notes));
    w.buffer(RS_BIND_ENVIRONMENT, lights.environment.buffer());
    for (uint32_t i = 0; i < 2 * RS_GI_STREAMS; ++i) w.buffer(RS_BIND_GI_RESERVOIRS, s.buffer(GiReservoirs0, i), i);
    const GBuffer& g = frame.gbuffer;
    w.image(RS_BIND_DEPTH, g.depth.view, g.depth.layout);
    w.image(RS_BIND_NORMAL, g.normal.view, g.normal.layout);
    w.image(RS_BIND_GEOMETRIC_NORMAL, g.geometricNormal.view, g.geometricNormal.layout);
    w.image(RS_BIND_BASE_COLOR, g.baseColor.view, g.baseColor.layout);
    w.image(RS_BIND_MATERIAL, g.material.view, g.material.layout);
    w.image(RS_BIND_MOTION, g.motion.view, g.motion.layout);
    w.image(RS_BIND_EMISSION, g.emission.view, g.emission.layout);
    w.image(RS_BIND_RADIANCE, frame.output.radiance, VK_IMAGE_LAYOUT_GENERAL);
    w.image(RS_BIND_DIFFUSE, frame.output.diffuse, VK_IMAGE_LAYOUT_GENERAL);
    w.image(RS_BIND_SPECULAR, frame.output.specular, VK_IMAGE_LAYOUT_GENERAL);
    w.image(RS_BIND_INDIRECT_DIFFUSE, frame.output.indirectDiffuse, VK_IMAGE_LAYOUT_GENERAL);
    w.image(RS_BIND_INDIRECT_SPECULAR, frame.output.indirectSpecular, VK_IMAGE_LAYOUT_GENERAL);
    w.image(RS_BIND_GRADIENT, frame.output.gradient, VK_IMAGE_LAYOUT_GENERAL);
    w.image(RS_BIND_DEBUG, frame.output.debug, VK_IMAGE_LAYOUT_GENERAL);
    w.flush(s.device());
}

}   // namespace restir
