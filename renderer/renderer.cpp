// SPDX-License-Identifier: MIT
#include "renderer/renderer.hpp"

#include <array>

#include "gpu/commands.hpp"
#include "renderer/frame_setup.hpp"
#include "renderer/frame_targets.hpp"
#include "renderer/patch_store.hpp"
#include "renderer/pipelines.hpp"
#include "renderer/primitives.hpp"
#include "renderer/projection.hpp"

namespace burin {

namespace {

using gpu::structure;

constexpr std::uint32_t kMaxSide = 8192;

std::uint64_t layer_bytes(ImageSize size) { return std::uint64_t{4} * size.width * size.height; }

// For the room: world_from_local takes the picture's corners, -1 to 1, to the screen's.
shared::DrawConstants screen_constants(const Screen& screen) {
    const Vec3 half_x = 0.5 * (screen.lower_right_world - screen.lower_left_world);
    const Vec3 half_y = 0.5 * (screen.upper_left_world - screen.lower_left_world);
    shared::DrawConstants c{};
    c.world_from_local[0] = glm::vec4(glm::vec3(half_x), 0.0f);
    c.world_from_local[1] = glm::vec4(glm::vec3(half_y), 0.0f);
    c.world_from_local[3] = glm::vec4(glm::vec3(screen.lower_left_world + half_x + half_y), 1.0f);
    return c;
}

VkViewport viewport_of(ImageSize size) {
    return {0.0f, 0.0f, static_cast<float>(size.width), static_cast<float>(size.height), 0.0f, 1.0f};
}

}  // namespace

class Renderer::Implementation {
public:
    static Result<std::unique_ptr<Implementation>> create(gpu::Device& device, ImageSize size);
    Result<StereoImage> render(const Scene& scene);
    PatchStore patches;

private:
    explicit Implementation(const gpu::Device& device) : device_(device) {}

    // One frame while it is recorded.
    struct Recording {
        gpu::Commands& commands;
        const Scene& scene;
        Shapes shapes;
        std::uint32_t draws = 0;
    };
    Result<void> upload_primitives();
    Result<void> draw_shadow_map(Recording& r);
    Result<void> draw_views(Recording& r);
    Result<void> use(Recording& r, PipelineKind kind);
    void begin_pass(Recording& r, VkRenderPass pass, VkFramebuffer framebuffer, ImageSize size,
                    std::span<const VkClearValue> clears);
    void end_pass(Recording& r) { vk().vkCmdEndRenderPass(r.commands.raw()); }
    void draw_surface(Recording& r);
    void draw(Recording& r, const PrimitiveRange& range, const shared::DrawConstants& constants);
    void bind(Recording& r, const gpu::Buffer& vertices, const gpu::Buffer& indices);
    void push(Recording& r, const shared::DrawConstants& constants);
    void copy_picture(Recording& r);
    Image picture(std::uint32_t layer) const;
    const VolkDeviceTable& vk() const { return device_.core()->vk; }

    gpu::Device device_;
    FrameTargets targets_;
    Pipelines pipelines_;
    Primitives primitives_;
    gpu::Buffer primitive_vertices_, primitive_indices_, readback_;
};

Result<std::unique_ptr<Renderer::Implementation>> Renderer::Implementation::create(gpu::Device& device,
                                                                                   ImageSize size) {
    if (size.width == 0 || size.height == 0 || size.width > kMaxSide || size.height > kMaxSide) {
        return fail("picture size",
                    std::to_string(size.width) + " x " + std::to_string(size.height) + " is not possible",
                    "choose 1 to " + std::to_string(kMaxSide) + " pixels each way");
    }
    auto made = std::unique_ptr<Implementation>(new Implementation(device));
    auto targets = FrameTargets::create(device, size);
    if (!targets) return std::unexpected(targets.error());
    made->targets_ = std::move(*targets);
    auto pipelines = Pipelines::create(device, made->targets_);
    if (!pipelines) return std::unexpected(pipelines.error());
    made->pipelines_ = std::move(*pipelines);
    auto readback = gpu::Buffer::create(device, gpu::BufferUse::readback, 2 * layer_bytes(size), "pictures");
    if (!readback) return std::unexpected(readback.error());
    made->readback_ = std::move(*readback);
    if (const auto done = made->upload_primitives(); !done) return std::unexpected(done.error());
    return made;
}

Result<void> Renderer::Implementation::upload_primitives() {
    primitives_ = make_primitives();
    const auto vertices = std::as_bytes(std::span(primitives_.vertices));
    const auto indices = std::as_bytes(std::span(primitives_.indices));
    auto vertex_buffer = gpu::Buffer::create(device_, gpu::BufferUse::vertex, vertices.size(), "shapes");
    if (!vertex_buffer) return std::unexpected(vertex_buffer.error());
    auto index_buffer = gpu::Buffer::create(device_, gpu::BufferUse::index, indices.size(), "shapes");
    if (!index_buffer) return std::unexpected(index_buffer.error());
    primitive_vertices_ = std::move(*vertex_buffer);
    primitive_indices_ = std::move(*index_buffer);
    if (const auto done = gpu::write(device_, primitive_vertices_, 0, vertices); !done) return done;
    return gpu::write(device_, primitive_indices_, 0, indices);
}

Result<StereoImage> Renderer::Implementation::render(const Scene& scene) {
    if (!can_be_seen(scene.screen, eyes_of(scene.viewer))) {
        return fail("viewer", "the eyes are behind the screen, or the screen is not a rectangle",
                    "check the wall's corners and the head pose");
    }
    auto commands = gpu::Commands::begin(device_);
    if (!commands) return std::unexpected(commands.error());
    const auto uploaded = patches.flush(device_, *commands);
    if (!uploaded) return std::unexpected(uploaded.error());
    commands->barrier();
    const Workpiece workpiece = place_workpiece(scene, patches.bounds(), patches.reach_m());
    pipelines_.uniforms() = frame_uniforms(scene, workpiece, FrameTargets::kShadowTexels);

    Recording recording{*commands, scene, shapes_of(scene, primitives_)};
    const gpu::Stamp start = commands->stamp();
    if (const auto done = draw_shadow_map(recording); !done) return std::unexpected(done.error());
    const gpu::Stamp shadowed = commands->stamp();
    if (const auto done = draw_views(recording); !done) return std::unexpected(done.error());
    const gpu::Stamp drawn = commands->stamp();
    copy_picture(recording);
    auto submission = std::move(*commands).submit();
    if (!submission) return std::unexpected(submission.error());
    if (const auto done = submission->wait(); !done) return std::unexpected(done.error());

    StereoImage result{picture(0), picture(1), {}};
    result.stats = {.gpu_s = submission->seconds_between(start, drawn).value_or(0.0),
                    .shadow_gpu_s = submission->seconds_between(start, shadowed).value_or(0.0),
                    .triangles = patches.triangles(),
                    .draws = recording.draws,
                    .patches = patches.patches(),
                    .uploaded_bytes = *uploaded};
    return result;
}

Result<void> Renderer::Implementation::use(Recording& r, PipelineKind kind) {
    const auto pipeline = pipelines_.pipeline(device_, kind, targets_);
    if (!pipeline) return std::unexpected(pipeline.error());
    vk().vkCmdBindPipeline(r.commands.raw(), VK_PIPELINE_BIND_POINT_GRAPHICS, *pipeline);
    return {};
}

void Renderer::Implementation::begin_pass(Recording& r, VkRenderPass pass, VkFramebuffer framebuffer, ImageSize size,
                                          std::span<const VkClearValue> clears) {
    auto info = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    info.renderPass = pass;
    info.framebuffer = framebuffer;
    info.renderArea = {{0, 0}, {size.width, size.height}};
    info.clearValueCount = static_cast<std::uint32_t>(clears.size());
    info.pClearValues = clears.data();
    const VkCommandBuffer raw = r.commands.raw();
    vk().vkCmdBeginRenderPass(raw, &info, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport = viewport_of(size);
    vk().vkCmdSetViewport(raw, 0, 1, &viewport);
    vk().vkCmdSetScissor(raw, 0, 1, &info.renderArea);
    const VkDescriptorSet set = pipelines_.set();
    vk().vkCmdBindDescriptorSets(raw, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout(), 0, 1, &set, 0, nullptr);
}

Result<void> Renderer::Implementation::draw_shadow_map(Recording& r) {
    constexpr std::uint32_t n = FrameTargets::kShadowTexels;
    VkClearValue clear{};
    clear.depthStencil.depth = 1.0f;
    begin_pass(r, targets_.shadow_pass.raw(), targets_.shadow_framebuffer.raw(), {n, n}, std::span(&clear, 1));
    if (const auto done = use(r, PipelineKind::shadow); !done) return done;
    draw_surface(r);
    bind(r, primitive_vertices_, primitive_indices_);
    for (const Shape& shape : r.shapes.solid) {
        if (shape.casts_shadow) draw(r, shape.range, shape.constants);
    }
    end_pass(r);
    return {};
}

Result<void> Renderer::Implementation::draw_views(Recording& r) {
    const Vec3 background = linear_of(r.scene.background);
    std::array<VkClearValue, 3> clears{};  // the finished picture is only cleared when it is drawn into directly
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
        clears[i].color = {{static_cast<float>(background.x), static_cast<float>(background.y),
                            static_cast<float>(background.z), 1.0f}};
    }
    clears[1].depthStencil.depth = 1.0f;
    begin_pass(r, targets_.view_pass.raw(), targets_.view_framebuffer.raw(), targets_.size, clears);
    // Front to back as far as it is known: what is drawn later and hidden costs little.
    if (const auto done = use(r, PipelineKind::solid); !done) return done;
    bind(r, primitive_vertices_, primitive_indices_);
    for (const Shape& shape : r.shapes.solid) draw(r, shape.range, shape.constants);
    draw_surface(r);
    bind(r, primitive_vertices_, primitive_indices_);
    if (r.scene.show_grid) {
        if (const auto done = use(r, PipelineKind::backdrop); !done) return done;
        draw(r, primitives_.screen_quad, screen_constants(r.scene.screen));
    }
    for (const PipelineKind faces : {PipelineKind::glass_back, PipelineKind::glass_front}) {
        if (r.shapes.glass.empty()) break;
        if (const auto done = use(r, faces); !done) return done;
        for (const Shape& shape : r.shapes.glass) draw(r, shape.range, shape.constants);
    }
    end_pass(r);
    return {};
}

void Renderer::Implementation::draw_surface(Recording& r) {
    if (patches.draws().empty()) return;
    bind(r, patches.vertex_buffer(), patches.index_buffer());
    push(r, surface_constants(r.scene));
    for (const PatchStore::DrawRange& range : patches.draws()) {
        vk().vkCmdDrawIndexed(r.commands.raw(), range.index_count, 1, range.first_index, 0, 0);
        ++r.draws;
    }
}

void Renderer::Implementation::draw(Recording& r, const PrimitiveRange& range, const shared::DrawConstants& constants) {
    push(r, constants);
    vk().vkCmdDrawIndexed(r.commands.raw(), range.index_count, 1, range.first_index, 0, 0);
    ++r.draws;
}

void Renderer::Implementation::bind(Recording& r, const gpu::Buffer& vertices, const gpu::Buffer& indices) {
    const VkBuffer vertex_buffer = vertices.raw();
    const VkDeviceSize offset = 0;
    vk().vkCmdBindVertexBuffers(r.commands.raw(), 0, 1, &vertex_buffer, &offset);
    vk().vkCmdBindIndexBuffer(r.commands.raw(), indices.raw(), 0, VK_INDEX_TYPE_UINT32);
}

void Renderer::Implementation::push(Recording& r, const shared::DrawConstants& constants) {
    vk().vkCmdPushConstants(r.commands.raw(), pipelines_.layout(),
                            VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(constants),
                            &constants);
}

void Renderer::Implementation::copy_picture(Recording& r) {
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 2};  // layers lie one after the other in the buffer
    region.imageExtent = {targets_.size.width, targets_.size.height, 1};
    vk().vkCmdCopyImageToBuffer(r.commands.raw(), targets_.picture.raw(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                readback_.raw(), 1, &region);
}

Image Renderer::Implementation::picture(std::uint32_t layer) const {
    const std::uint64_t bytes = layer_bytes(targets_.size);
    const auto pixels = readback_.mapped_as<std::uint8_t>().subspan(layer * bytes, bytes);
    return {targets_.size, {pixels.begin(), pixels.end()}};
}

// ---- Renderer

Result<Renderer> Renderer::create(gpu::Device& device, ImageSize size) {
    auto implementation = Implementation::create(device, size);
    if (!implementation) return std::unexpected(implementation.error());
    return Renderer(std::move(*implementation));
}

Renderer::Renderer(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::set_patch(std::uint32_t id, std::span<const shared::SurfaceVertex> vertices,
                         std::span<const std::uint32_t> indices) {
    implementation_->patches.set(id, vertices, indices);
}
void Renderer::remove_patch(std::uint32_t id) { implementation_->patches.remove(id); }
void Renderer::clear_patches() { implementation_->patches.clear(); }
Result<StereoImage> Renderer::render(const Scene& scene) { return implementation_->render(scene); }

}  // namespace burin
