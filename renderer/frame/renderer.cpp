// SPDX-License-Identifier: MIT
#include "renderer/frame/renderer.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/try.hpp"
#include "gpu/commands.hpp"
#include "picture/frame_setup.hpp"
#include "picture/lamp_view.hpp"
#include "picture/primitives.hpp"
#include "renderer/frame/draw_calls.hpp"
#include "renderer/frame/frame_targets.hpp"
#include "renderer/frame/magnify.hpp"
#include "renderer/frame/mesh_store.hpp"
#include "renderer/frame/pipelines.hpp"
#include "renderer/frame/redraw.hpp"
#include "renderer/frame/scene_choice.hpp"
#include "renderer/panel/panel_quad.hpp"
#include "renderer/surface/drawn_patches.hpp"
#include "wall/projection.hpp"

namespace burin::renderer {

namespace {

using gpu::structure;

// Returns the pipeline for what is lit at every pixel.
PipelineKind solid_of(const picture::Picture& picture, bool shaded) {
    if (shaded) return PipelineKind::solid_shaded;
    return picture.capsules.empty() ? PipelineKind::solid : PipelineKind::solid_beside_capsules;
}

}  // namespace

class Renderer::Implementation {
public:
    static Result<std::unique_ptr<Implementation>> create(gpu::Device& device, ImageSize size,
                                                          const RendererOptions& options);
    Result<RenderStats> record(gpu::Commands& commands, const picture::Picture& picture, std::uint32_t pixel);
    Result<StereoImage> render(const picture::Picture& picture, std::uint32_t pixel);
    void show_panel(VkImageView panel) {
        if (panel == panel_) return;
        panel_ = panel;
        ++panel_pictures_;
    }

    Result<void> resize(ImageSize size, Views views);

    std::shared_ptr<SurfaceStore> surface;
    Savings savings;
    FrameTargets targets;
    std::optional<Shown> shown;  // empty: no picture yet
    RenderStats stats;

private:
    Implementation(const gpu::Device& device, std::shared_ptr<SurfaceStore> shared)
        : surface(shared ? shared : std::make_shared<SurfaceStore>(device)),
          device_(device),
          owns_surface_(!shared),
          drawn_(surface->patches()) {}

    // State of one part of a frame while it is recorded.
    struct Recording {
        gpu::Commands& commands;
        DrawCalls calls;
        const picture::Picture& picture;
        bool shaded = false;  // objects cast shadows
        PixelRect part;
        picture::Shapes shapes;
        PatchDraws surface;
        picture::Workpiece workpiece{};
    };
    struct StandingPanel {
        std::optional<PanelQuad> quad;
        std::uint64_t shows = 0;  // number of the picture it shows
    };
    Result<void> upload_primitives();
    Result<void> draw_with(std::uint32_t pixel);
    std::vector<PixelRect> parts_to_draw(const Shown& wanted);
    Result<void> draw_part(gpu::Commands& commands, const Shown& wanted, const PixelRect& part, bool shaded);
    void upload_uniforms(gpu::Commands& commands, const Shown& wanted);
    Result<void> draw_views(Recording& r);
    void begin_pass(Recording& r);
    void begin_glass_pass(Recording& r);
    Result<void> draw_shapes(Recording& r, PipelineKind kind, std::span<const picture::Shape> shapes);
    Result<void> draw_surface(Recording& r);
    Result<void> draw_surface(Recording& r, PipelineKind kind, std::span<const DrawRange> ranges);
    Result<void> draw_room(Recording& r);
    Result<void> draw_panel(Recording& r);
    Result<void> make_ready(StandingPanel& panel, bool fades);
    Result<void> draw_glass(Recording& r);
    Result<void> draw_clear_objects(Recording& r);
    void draw_primitives(Recording& r, std::span<const picture::Shape> shapes);
    void draw_meshes(Recording& r, std::span<const picture::Shape> shapes);
    Result<void> use(Recording& r, PipelineKind kind);
    static void draw(Recording& r, const picture::PrimitiveRange& range, const shared::DrawConstants& constants);
    void bind_primitives(Recording& r) { r.calls.bind(primitive_vertices_, primitive_lights_, primitive_indices_); }
    std::uint32_t pipelines_created() const {
        std::uint32_t created = pipelines_.created();
        for (const auto& panels : panels_)
            for (const StandingPanel& panel : panels) created += panel.quad ? 1 : 0;
        return created;
    }
    const VolkDeviceTable& vk() const { return device_.core()->vk; }

    // Returns what frames are drawn into at present.
    const FrameTargets& drawn_into() const { return pixel_ == 1 ? targets : *fewer_; }

    gpu::Device device_;
    bool owns_surface_ = false;
    std::uint32_t pixel_ = 1;            // side of what is drawn as one, in pixels of the picture
    std::optional<FrameTargets> fewer_;  // of so many fewer pixels, once there have been any
    DrawnPatches drawn_;
    Pipelines pipelines_;
    picture::Primitives primitives_;
    MeshStore meshes_;
    gpu::Buffer primitive_vertices_, primitive_lights_, primitive_indices_;
    Readback readback_;  // allocated at first use
    // Also created at first use. Indexed by views, then by whether parallax fades.
    std::array<std::array<StandingPanel, 2>, kViewChoices> panels_;
    VkImageView panel_ = VK_NULL_HANDLE;
    std::uint64_t panel_pictures_ = 0;  // number of pictures given to the renderer
};

Result<std::unique_ptr<Renderer::Implementation>> Renderer::Implementation::create(gpu::Device& device, ImageSize size,
                                                                                   const RendererOptions& options) {
    const std::uint32_t most = device.capabilities().msaa_samples;
    const std::uint32_t samples = options.samples == 0 ? most : options.samples;
    if (samples != 1 && samples != most) {
        return fail(
            "samples a pixel",
            device.info().name + " draws with 1 or " + std::to_string(most) + ", not " + std::to_string(samples),
            "choose one of these");
    }
    if (options.surface && !options.surface->is_on(device)) {
        return fail("renderer", "the surface is on another graphics device", "give each device a surface of its own");
    }
    auto made = std::unique_ptr<Implementation>(new Implementation(device, options.surface));
    made->savings = options.savings;
    BURIN_TRY(targets, FrameTargets::create(device, size, samples, options.views));
    made->targets = std::move(targets);
    BURIN_TRY(pipelines, Pipelines::create(device));
    made->pipelines_ = std::move(pipelines);
    BURIN_TRY_DO(made->upload_primitives());
    return made;
}

// Keeps the pipelines: they fit any targets of the same formats, views and number of samples.
Result<void> Renderer::Implementation::resize(ImageSize size, Views views) {
    BURIN_TRY(other, FrameTargets::create(device_, size, targets.samples, views));
    targets = std::move(other);
    fewer_.reset();
    pixel_ = 1;
    shown.reset();
    return {};
}

// Makes ready to draw with pixels of this side; another than before makes the next frame a full redraw.
Result<void> Renderer::Implementation::draw_with(std::uint32_t pixel) {
    if (pixel == pixel_) return {};
    const ImageSize size = drawn_size(targets.size, pixel);
    if (pixel > 1 && !(fewer_ && fewer_->size == size)) {
        BURIN_TRY(made, FrameTargets::create(device_, size, targets.samples, targets.views));
        fewer_ = std::move(made);
    }
    pixel_ = pixel;
    shown.reset();
    return {};
}

Result<void> Renderer::Implementation::upload_primitives() {
    primitives_ = picture::make_primitives();
    const std::vector<geometry::VertexLight> lights(primitives_.vertices.size());
    const auto put = [&](gpu::Buffer& buffer, gpu::BufferUse use, std::span<const std::byte> bytes) -> Result<void> {
        BURIN_TRY(made, gpu::Buffer::create(device_, use, bytes.size(), "shapes"));
        buffer = std::move(made);
        return gpu::write(device_, buffer, 0, bytes);
    };
    auto done = put(primitive_vertices_, gpu::BufferUse::vertex, std::as_bytes(std::span(primitives_.vertices)));
    if (done) done = put(primitive_lights_, gpu::BufferUse::vertex, std::as_bytes(std::span(lights)));
    if (done) done = put(primitive_indices_, gpu::BufferUse::index, std::as_bytes(std::span(primitives_.indices)));
    return done;
}

Result<RenderStats> Renderer::Implementation::record(gpu::Commands& commands, const picture::Picture& picture,
                                                     std::uint32_t pixel) {
    if (!wall::can_be_seen(picture.screen, wall::eyes_of(picture.viewer))) {
        return fail("viewer", "the eyes are behind the screen, or the screen is not a rectangle",
                    "check the wall's corners and the head pose");
    }
    if (!(picture.edge_fade >= 0.0 && picture.edge_fade <= 1.0 && picture.edge_fade_band >= 0.0)) {
        return fail("fade of parallax", "is not from 0 to 1, or its band is below 0",
                    "choose 0 to 1, and a band of 0.2");
    }
    BURIN_TRY_DO(draw_with(std::max(pixel, 1u)));
    commands.barrier();  // waits until the previous frame has read what is now overwritten
    BURIN_TRY(uploaded, owns_surface_ ? surface->flush(commands) : Result<std::uint64_t>(0));
    const PatchStore& patches = surface->patches();
    Shown wanted{picture, picture::place_workpiece(picture, patches.bounds(), patches.reach_m()), {}, panel_pictures_};
    wanted.depth = picture::depth_range(picture, wanted.workpiece);
    stats = {.part = {},
             .parts = parts_to_draw(wanted),
             .whole = false,
             .triangles = patches.triangles(),
             .patches = patches.patches(),
             .patch_counts = {},
             .shapes_left_out = 0,
             .plain_room = 0,
             .draws = 0,
             .uploaded_bytes = uploaded,
             .pipelines = pipelines_created()};
    const std::optional<picture::LampView> lamp = picture::lamp_view(picture);
    if (!stats.parts.empty()) {
        BURIN_TRY_DO(meshes_.put(device_, commands, picture::meshes_of(picture)));
        upload_uniforms(commands, wanted);
        commands.barrier();
        if (lamp) BURIN_TRY_DO(pipelines_.shadow_map().record(device_, commands, *lamp, meshes_));
    }
    for (const PixelRect& part : stats.parts) BURIN_TRY_DO(draw_part(commands, wanted, part, lamp.has_value()));
    stats.pipelines = pipelines_created();
    stats.whole = !stats.parts.empty() && stats.parts.front() == all_of(drawn_into().size);
    if (pixel_ > 1 && !stats.parts.empty()) {
        magnify(device_, commands, drawn_into(), targets);
        stats.part = all_of(targets.size);
        stats.parts = {stats.part};
    }
    shown = std::move(wanted);
    return stats;
}

std::vector<PixelRect> Renderer::Implementation::parts_to_draw(const Shown& wanted) {
    const PixelRect all = all_of(drawn_into().size);
    std::vector<PixelRect> parts{all};
    const std::span<const Box> occluders = surface->occluders();
    DrawnPatches::Changes changes = drawn_.take_changes();
    if (changes.whole) shown.reset();
    if (savings.parts_only && shown && same_room(*shown, wanted)) {
        std::vector<Box>& changed = changes.boxes;
        const auto add = [&](const std::vector<Box>& more) { changed.insert(changed.end(), more.begin(), more.end()); };
        add(changed_near_tool(drawn_.patches(), shown->picture, wanted.picture, drawn_into().size, occluders));
        add(choose_rates(drawn_, wanted.picture, drawn_into().size, savings));
        parts = damage_rectangles(changed_rects(*shown, wanted, drawn_into().size, changed), drawn_into().size);
        if (!savings.parts_apart && !parts.empty())
            parts = {std::accumulate(parts.begin(), parts.end(), PixelRect{}, around)};
    }
    if (std::ranges::find(parts, all) != parts.end()) {
        choose_levels(drawn_, wanted.picture, drawn_into().size, savings, occluders);
        parts = {all};
    }
    return parts;
}

Result<void> Renderer::Implementation::draw_part(gpu::Commands& commands, const Shown& wanted, const PixelRect& part,
                                                 bool shaded) {
    const picture::Picture& picture = wanted.picture;
    ShownShapes shapes = shapes_in(part, picture, primitives_, drawn_into().size, savings);
    const DrawCalls calls(device_, commands, pipelines_.layout());
    Recording r{commands, calls, picture, shaded, part, std::move(shapes.shapes), {}};
    r.workpiece = wanted.workpiece;
    r.surface = choose_draws(drawn_, picture, drawn_into().size, part, savings, surface->occluders(), pixel_ > 1);
    const auto done = draw_views(r);
    stats.part = around(stats.part, part);
    stats.shapes_left_out += shapes.left_out;
    stats.patch_counts += r.surface.counts;
    stats.draws += r.calls.draws();
    return done;
}

void Renderer::Implementation::upload_uniforms(gpu::Commands& commands, const Shown& wanted) {
    const shared::FrameUniforms uniforms = picture::frame_uniforms(wanted.picture, wanted.workpiece);
    commands.upload(pipelines_.uniforms(), 0, gpu::bytes_of(uniforms));
}

Result<void> Renderer::Implementation::draw_views(Recording& r) {
    begin_pass(r);
    // Front to back as far as the order is known: hidden fragments that come later cost little.
    auto done = draw_shapes(r, solid_of(r.picture, r.shaded), r.shapes.solid);
    if (done) done = draw_surface(r);
    // Whatever is before it: what is seen of the tool covers it afterwards, and the room where nothing is before it.
    if (done) done = draw_shapes(r, PipelineKind::hidden, r.shapes.hidden);
    if (done) done = draw_shapes(r, solid_of(r.picture, r.shaded), r.shapes.tool);
    if (done) done = draw_room(r);
    if (done) done = draw_panel(r);
    if (done) done = draw_glass(r);
    vk().vkCmdEndRenderPass(r.commands.raw());
    return done;
}

void Renderer::Implementation::begin_pass(Recording& r) {
    const Vec3 background = targets.encodes ? r.picture.background : picture::linear_of(r.picture.background);
    std::array<VkClearValue, 3> clears{};  // the resolved picture's entry counts only where it is drawn into directly
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
        clears[i].color = {{static_cast<float>(background.x), static_cast<float>(background.y),
                            static_cast<float>(background.z), 1.0f}};
    }
    clears[1].depthStencil.depth = 1.0f;
    const bool whole = r.part == all_of(drawn_into().size);
    auto info = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    info.renderPass = whole ? drawn_into().whole_pass.raw() : drawn_into().part_pass.raw();
    info.framebuffer = drawn_into().framebuffer.raw();
    info.clearValueCount = static_cast<std::uint32_t>(clears.size());
    info.pClearValues = clears.data();
    r.calls.begin(info, r.part, drawn_into().size, pipelines_.set());
}

void Renderer::Implementation::begin_glass_pass(Recording& r) {
    auto info = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    info.renderPass = drawn_into().glass_pass.raw();
    info.framebuffer = drawn_into().glass_framebuffer.raw();
    r.calls.begin(info, r.part, drawn_into().size, pipelines_.set());
}

Result<void> Renderer::Implementation::draw_shapes(Recording& r, PipelineKind kind,
                                                   std::span<const picture::Shape> shapes) {
    if (shapes.empty()) return {};
    BURIN_TRY_DO(use(r, kind));
    draw_primitives(r, shapes);
    draw_meshes(r, shapes);
    return {};
}

void Renderer::Implementation::draw_primitives(Recording& r, std::span<const picture::Shape> shapes) {
    bind_primitives(r);
    for (const picture::Shape& shape : shapes)
        if (!shape.mesh) draw(r, shape.range, shape.constants);
}

void Renderer::Implementation::draw_meshes(Recording& r, std::span<const picture::Shape> shapes) {
    if (std::ranges::none_of(shapes, [](const picture::Shape& shape) { return shape.mesh != nullptr; })) return;
    r.calls.bind(meshes_);
    for (const picture::Shape& shape : shapes)
        if (shape.mesh) r.calls.draw(meshes_.at(*shape.mesh), shape.constants);
}

Result<void> Renderer::Implementation::draw_surface(Recording& r) {
    // Shadows of capsules and objects are finer than any vertices.
    const PipelineKind solid = solid_of(r.picture, r.shaded),
                       fine = solid == PipelineKind::solid ? PipelineKind::fine : solid;
    BURIN_TRY_DO(draw_surface(r, fine, r.surface.fine));
    return draw_surface(r, solid, r.surface.solid);
}

Result<void> Renderer::Implementation::draw_surface(Recording& r, PipelineKind kind,
                                                    std::span<const DrawRange> ranges) {
    if (ranges.empty()) return {};
    BURIN_TRY_DO(use(r, kind));
    const PatchStore& patches = surface->patches();
    r.calls.bind(patches.vertex_buffer(), patches.light_buffer(), patches.index_buffer());
    r.calls.push(picture::surface_constants(r.picture));
    for (const DrawRange& range : ranges) r.calls.draw(range.index_count, range.first_index);
    return {};
}

Result<void> Renderer::Implementation::draw_room(Recording& r) {
    if (!r.picture.show_grid) return {};
    std::vector<RoomPart> parts{{r.part, RoomLook::full}};
    if (savings.plain_room) parts = room_parts(r.picture, r.workpiece, drawn_into().size, r.part);
    bind_primitives(r);
    const PipelineKind full = r.shaded ? PipelineKind::backdrop_shaded : PipelineKind::backdrop;
    for (const auto& [look, kind] :
         {std::pair(RoomLook::full, full), std::pair(RoomLook::without_shadows, PipelineKind::backdrop_without_shadows),
          std::pair(RoomLook::plain, PipelineKind::backdrop_plain)}) {
        for (const RoomPart& part : parts) {
            if (part.look != look) continue;
            BURIN_TRY_DO(use(r, kind));
            r.calls.clip(part.rect);
            draw(r, primitives_.screen_quad, picture::screen_constants(r.picture.screen));
            if (look != RoomLook::full) stats.plain_room += std::uint64_t{part.rect.width} * part.rect.height;
        }
    }
    r.calls.clip(r.part);
    return {};
}

Result<void> Renderer::Implementation::draw_panel(Recording& r) {
    if (!r.picture.panel || panel_ == VK_NULL_HANDLE) return {};
    const bool fades = r.picture.edge_fade > 0.0;
    StandingPanel& panel = panels_[static_cast<std::size_t>(targets.views)][fades ? 1 : 0];
    BURIN_TRY_DO(make_ready(panel, fades));
    panel.quad->record(r.commands.raw(), r.picture.panel->stand, pipelines_.set());
    ++stats.draws;
    return {};
}

Result<void> Renderer::Implementation::make_ready(StandingPanel& panel, bool fades) {
    if (!panel.quad) {
        BURIN_TRY(made, PanelQuad::create(device_, {targets.whole_pass.raw(), targets.samples, targets.encodes, fades,
                                                    pipelines_.set_layout()}));
        panel.quad = std::move(made);
    }
    if (panel.shows == panel_pictures_) return {};
    BURIN_TRY_DO(panel.quad->show(panel_));
    panel.shows = panel_pictures_;
    return {};
}

Result<void> Renderer::Implementation::draw_glass(Recording& r) {
    if (r.shapes.glass.empty()) return {};
    if (drawn_into().encodes) {
        vk().vkCmdEndRenderPass(r.commands.raw());
        begin_glass_pass(r);
    }
    // The objects stand within the boxes.
    BURIN_TRY_DO(use(r, PipelineKind::glass_back));
    draw_primitives(r, r.shapes.glass);
    BURIN_TRY_DO(draw_clear_objects(r));
    BURIN_TRY_DO(use(r, PipelineKind::glass_front));
    draw_primitives(r, r.shapes.glass);
    return {};
}

// Draws the far and the near faces of one object after another, the farthest object first: what is nearer lies over it.
Result<void> Renderer::Implementation::draw_clear_objects(Recording& r) {
    for (const picture::Shape& shape : r.shapes.glass) {
        if (!shape.mesh) continue;
        for (const PipelineKind faces : {PipelineKind::glass_back, PipelineKind::glass_front}) {
            BURIN_TRY_DO(use(r, faces));
            r.calls.bind(meshes_);
            r.calls.draw(meshes_.at(*shape.mesh), shape.constants);
        }
    }
    return {};
}

Result<void> Renderer::Implementation::use(Recording& r, PipelineKind kind) {
    BURIN_TRY(pipeline, pipelines_.pipeline(device_, kind, r.picture.edge_fade > 0.0, targets));
    r.calls.use(pipeline);
    return {};
}

void Renderer::Implementation::draw(Recording& r, const picture::PrimitiveRange& range,
                                    const shared::DrawConstants& constants) {
    r.calls.push(constants);
    r.calls.draw(range.index_count, range.first_index);
}

// ---- Reading back

Result<StereoImage> Renderer::Implementation::render(const picture::Picture& picture, std::uint32_t pixel) {
    BURIN_TRY_DO(readback_.fit(device_, targets.size));
    BURIN_TRY(commands, gpu::Commands::begin(device_));
    BURIN_TRY_DO(record(commands, picture, pixel));
    readback_.copy(device_, commands, targets.picture.raw());
    BURIN_TRY(submission, std::move(commands).submit());
    BURIN_TRY_DO(submission.wait());
    return readback_.pictures();
}

// ---- Renderer

Result<Renderer> Renderer::create(gpu::Device& device, ImageSize size, const RendererOptions& options) {
    BURIN_TRY(implementation, Implementation::create(device, size, options));
    return Renderer(std::move(implementation));
}

Renderer::Renderer(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

SurfaceStore& Renderer::surface() { return *implementation_->surface; }
void Renderer::show_panel(VkImageView panel) { implementation_->show_panel(panel); }
Result<RenderStats> Renderer::record(gpu::Commands& commands, const picture::Picture& picture, std::uint32_t pixel) {
    return implementation_->record(commands, picture, pixel);
}
VkImageView Renderer::both_eyes() const { return implementation_->targets.both_eyes.raw(); }
ImageSize Renderer::size() const { return implementation_->targets.size; }
Result<void> Renderer::resize(ImageSize size, Views views) { return implementation_->resize(size, views); }
void Renderer::forget_picture() { implementation_->shown.reset(); }
void Renderer::set_savings(const Savings& savings) {
    implementation_->savings = savings;
    forget_picture();
}
Result<StereoImage> Renderer::render(const picture::Picture& picture, std::uint32_t pixel) {
    return implementation_->render(picture, pixel);
}
const RenderStats& Renderer::stats() const { return implementation_->stats; }

}  // namespace burin::renderer
