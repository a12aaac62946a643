// SPDX-License-Identifier: MIT
#include "desk/panel/panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "base/try.hpp"
#include "desk/panel/panel_input.hpp"
#include "desk/panel/panel_sections.hpp"

namespace burin::session {

namespace {

using panel::Kit;

// Layouts after the last event before the panel is taken to rest: lists close, fields lose the keyboard.
constexpr int kSettling = 3;

// How long the mouse rests on something before it says what that is.
constexpr Nanoseconds kTipAfter_ns = 600'000'000;

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                    ImGuiWindowFlags_NoNav;

// Layouts are made in pixels of the whole picture; left: where the mesh begins in it.
PixelRect clip_of(const ImVec4& clip, ImageSize size, float left) {
    const auto within = [](float value, std::uint32_t most) {
        return static_cast<std::uint32_t>(std::clamp(value, 0.0f, static_cast<float>(most)));
    };
    const std::uint32_t x0 = within(clip.x - left, size.width), y0 = within(clip.y, size.height);
    const std::uint32_t x1 = within(clip.z - left, size.width), y1 = within(clip.w, size.height);
    return {x0, y0, x1 > x0 ? x1 - x0 : 0, y1 > y0 ? y1 - y0 : 0};
}

renderer::PanelMesh mesh_of(const ImDrawData& data, ImageSize size, float left) {
    renderer::PanelMesh mesh;
    mesh.vertices.reserve(static_cast<std::size_t>(data.TotalVtxCount));
    mesh.indices.reserve(static_cast<std::size_t>(data.TotalIdxCount));
    for (int l = 0; l < data.CmdListsCount; ++l) {
        const ImDrawList& list = *data.CmdLists[l];
        const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
        const auto first_index = static_cast<std::uint32_t>(mesh.indices.size());
        for (const ImDrawVert& v : list.VtxBuffer)
            mesh.vertices.push_back({v.pos.x - left, v.pos.y, v.uv.x, v.uv.y, v.col});
        for (const ImDrawIdx i : list.IdxBuffer) mesh.indices.push_back(first_vertex + i);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.ElemCount == 0) continue;
            mesh.draws.push_back(
                {clip_of(command.ClipRect, size, left), first_index + command.IdxOffset, command.ElemCount});
        }
    }
    return mesh;
}

}  // namespace

double panel_scale(double reading_distance_m, double metres_per_px) {
    // Capitals are 0.6 of the letters' 16 px in height and must subtend 21 minutes of arc.
    constexpr double kCapital_px = 0.6 * 16.0, kAngle_rad = 21.0 / 60.0 * std::numbers::pi / 180.0;
    return reading_distance_m * kAngle_rad / (kCapital_px * metres_per_px);
}

// Holds a toolkit context and makes it current while it works.
class Panel::Implementation {
public:
    Implementation(ImageSize size, float scale) : size_(size) {
        kit_.scale = scale;
        ImGuiContext* const before = ImGui::GetCurrentContext();
        context_ = ImGui::CreateContext();
        ImGui::SetCurrentContext(context_);
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = io.LogFilename = nullptr;
        io.ConfigInputTextCursorBlink = false;  // a panel at rest is not painted
        panel::name_keys();
        panel::apply_style(scale);
        ImGui::SetCurrentContext(before);
    }
    ~Implementation() { ImGui::DestroyContext(context_); }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    Result<void> load_letters(const std::string& file) {
        const Current current(context_);
        type_file_ = file;
        BURIN_TRY(type, panel::load_type(file, kit_.scale, std::vector(letters_.begin(), letters_.end())));
        kit_.type = std::move(type);
        atlas_ = panel::atlas_of_context();
        ++atlases_;
        return {};
    }

    Result<void> rescale(float scale) {
        if (scale == kit_.scale) return {};
        kit_.scale = scale;
        resting_ = kSettling;
        const Current current(context_);
        panel::apply_style(scale);
        return load_letters(type_file_);
    }

    // Has letters ready that texts of people hold: names of files and objects, messages, what is typed.
    void learn_letters(const PanelModel& model) {
        const std::size_t before = letters_.size();
        const auto learn = [&](std::string_view text) {
            for (const std::uint32_t letter : panel::letters_beyond_latin(text)) letters_.insert(letter);
        };
        for (const std::string* text : {&model.workpiece.name, &model.export_path, &model.tool.file}) learn(*text);
        learn(kit_.memory.path + kit_.memory.name);
        for (const auto& field : kit_.memory.fields) learn(field.second);
        if (model.document) learn(model.document->name + "\u2026");  // of its buttons
        if (model.question) learn(model.question->name + model.question->path + "\u2026");
        for (const std::string& name : model.object_names) learn(name);
        for (const PanelNote& note : model.log) learn(note.text);
        for (const PanelSource& source : model.sources) learn(source.detail);
        if (model.activity) {
            for (const std::string* text : {&model.activity->title, &model.activity->aside, &model.activity->page})
                learn(*text);
            learn(panel::texts_of(*model.activity));
            if (model.activity->task) learn(model.activity->task->next + model.activity->task->state);
            for (const std::string& paragraph : model.activity->help) learn(paragraph);
        }
        if (letters_.size() > before) static_cast<void>(load_letters(type_file_));  // the file was good before
    }

    const PanelFrame& show(const PanelModel& model, Nanoseconds time_ns) {
        frame_.actions.clear();
        const bool changes = frame_.changes_ns && time_ns >= *frame_.changes_ns;
        const bool still = events_.empty() && resting_ <= 0 && !changes && model_ && *model_ == model;
        if (still) {
            ++spared_;
            frame_.changed = false;
            last_ns_ = time_ns;
            return frame_;
        }
        resting_ = !events_.empty() || !model_ ? kSettling : std::max(resting_ - 1, 0);
        model_ = model;
        const Current current(context_);
        learn_letters(model);
        const bool over_picture = !is_empty(picture_) && (!model.notes.empty() || model.first_steps || model.opening ||
                                                          model.question || (model.activity && model.activity->task));
        const ImageSize size_before = frame_.size;
        frame_.parts.clear();
        frame_.changes_ns.reset();
        renderer::PanelMesh mesh = model.visible || over_picture ? lay_out(model, time_ns) : hidden();
        frame_.changed = laid_out_before_ ? mesh != frame_.mesh || frame_.size != size_before : true;
        laid_out_before_ = true;
        frame_.mesh = std::move(mesh);
        last_ns_ = time_ns;
        return frame_;
    }

    // Makes a context current and restores the previous one at the end.
    class Current {
    public:
        explicit Current(ImGuiContext* context) : before_(ImGui::GetCurrentContext()) {
            ImGui::SetCurrentContext(context);
        }
        ~Current() { ImGui::SetCurrentContext(before_); }
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;

    private:
        ImGuiContext* before_;
    };

    // Where the panel begins in the picture that it lies over.
    [[nodiscard]] float left() const {
        return picture_.width > size_.width ? static_cast<float>(picture_.width - size_.width) : 0.0f;
    }

    std::string type_file_;
    std::set<std::uint32_t> letters_;  // beyond Latin 1, that were shown
    std::uint64_t atlases_ = 0;
    ImageSize size_, picture_;
    Kit kit_;
    renderer::PanelAtlas atlas_;
    panel::PanelEvents events_;
    PanelFrame frame_;
    std::optional<PanelModel> model_;
    bool wand_pressed_ = false;
    std::optional<Vec2> wand_px_;
    bool laid_out_before_ = false;
    int resting_ = 0;
    float page_height_ = 0.0f;
    std::uint64_t laid_out_ = 0, spared_ = 0;

private:
    // Lays out once for each step of the events since the last time, and once more for a list that has opened or
    // contents whose height has changed.
    renderer::PanelMesh lay_out(const PanelModel& model, Nanoseconds time_ns) {
        double dt_s = std::clamp(1e-9 * static_cast<double>(time_ns - last_ns_), 1e-4, 0.25);
        int refits = 0;
        do {
            ImGuiIO& io = ImGui::GetIO();
            const ImageSize whole = is_empty(picture_) ? size_ : picture_;
            io.DisplaySize = {static_cast<float>(whole.width), static_cast<float>(whole.height)};
            io.DeltaTime = static_cast<float>(dt_s);
            dt_s = 1e-4;
            events_.hand_over();
            ImGui::NewFrame();
            ImGui::PushFont(kit_.type.text);
            kit_.places.clear();
            kit_.actions.clear();
            kit_.parts.clear();
            kit_.again = false;
            kit_.hovered.clear();
            if (model.page_alone) {
                show_page(model);
            } else {
                if (model.visible) show_column(model);
                show_over_all(model, time_ns);
            }
            ImGui::PopFont();
            ImGui::Render();
            ++laid_out_;
            std::ranges::move(kit_.actions, std::back_inserter(frame_.actions));
            // The toolkit gives the scroll bar the length that fits the contents of the layout before.
            const bool fits = std::exchange(scrolls_over_, inside_height_) == inside_height_;
            kit_.again = kit_.again || (!fits && ++refits < kSettling);
        } while (!events_.empty() || kit_.again);
        frame_.wants_mouse = ImGui::GetIO().WantCaptureMouse;
        frame_.wants_keyboard = ImGui::GetIO().WantTextInput;
        if (model.question) frame_.wants_mouse = frame_.wants_keyboard = true;
        return taken(model.visible);
    }

    // Takes what was laid out: the column alone, or all that lies over the picture.
    renderer::PanelMesh taken(bool column) {
        const bool alone = is_empty(picture_) || kit_.parts.empty();
        frame_.size = alone ? size_ : picture_;
        frame_.parts = alone ? std::vector<PixelRect>{} : kit_.parts;
        if (column)
            frame_.parts.push_back({alone ? 0 : static_cast<std::uint32_t>(left()), 0, size_.width, size_.height});
        return mesh_of(*ImGui::GetDrawData(), frame_.size, alone ? left() : 0.0f);
    }

    // Shows messages, the card of first steps and a tool-tip, which move nothing that lies below.
    void show_over_all(const PanelModel& model, Nanoseconds time_ns) {
        const ImVec2 screen = ImGui::GetIO().DisplaySize;
        const bool has_column = model.visible || (model.opening && left() > static_cast<float>(size_.width));
        panel::Area free{{0.0f, 0.0f}, {has_column ? left() : screen.x, screen.y}};
        if (is_empty(picture_)) free = {{0.0f, 0.0f}, {screen.x, column_bottom_}};
        kit_.visible_lo = {0.0f, 0.0f};
        kit_.visible_hi = screen;
        if (model.opening) return panel::show_opening(kit_, *model.opening, free);
        if (model.first_steps && !is_empty(picture_)) {
            panel::show_first_steps(kit_, model, free);
            const auto card = kit_.places.find("first-steps");
            if (card != kit_.places.end()) free.hi.y = static_cast<float>(card->second.y);
        }
        const bool is_task_here = model.activity && model.activity->task && !model.for_operator;
        if (is_task_here && !is_empty(picture_)) {
            panel::show_task(kit_, *model.activity->task, free);
            const auto task = kit_.places.find("task");
            if (task != kit_.places.end()) free.hi.y = static_cast<float>(task->second.y);
        }
        if (model.for_operator && has_tables(model)) {  // the log beside the tables has what is told
            PanelModel conditions = model;
            conditions.notes.clear();
            panel::show_notes(kit_, conditions, free);
        } else {
            panel::show_notes(kit_, model, free);
        }
        if (model.question) return panel::show_question(kit_, *model.question, free);
        kit_.memory.question.clear();
        if (kit_.hovered != tip_for_) {
            tip_for_ = kit_.hovered;
            tip_from_ns_ = time_ns;
        }
        const Nanoseconds due_ns = tip_from_ns_ + kTipAfter_ns;
        if (tip_for_.empty() || ImGui::IsAnyItemActive()) return;
        if (time_ns >= due_ns)
            panel::show_tip(kit_, tip_for_, is_empty(picture_) ? 0.0f : left());
        else
            frame_.changes_ns = due_ns;
    }

    renderer::PanelMesh hidden() {
        events_.drop();
        kit_.places.clear();
        frame_.size = size_;
        ImGuiIO& io = ImGui::GetIO();
        for (bool& down : io.MouseDown) down = false;
        for (bool& down : io.KeysDown) down = false;
        frame_.wants_mouse = frame_.wants_keyboard = false;
        return {};
    }

    // Begins a window that fills the panel.
    void begin_ground(float margin, float above) {
        const ImVec2 from{left(), 0.0f}, size{static_cast<float>(size_.width), static_cast<float>(size_.height)};
        const ImVec2 to{from.x + size.x, size.y};
        ImGui::SetNextWindowPos(from);
        ImGui::SetNextWindowSize(size);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {margin, above});
        ImGui::Begin("panel", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
        ImGui::PopStyleVar();
        ImDrawList& ground = *ImGui::GetWindowDrawList();
        ground.PushClipRectFullScreen();
        ground.AddRectFilled(from, to, panel::kGround);
        ground.PopClipRect();
        kit_.visible_lo = from;
        kit_.visible_hi = to;
    }

    [[nodiscard]] static bool has_tables(const PanelModel& model) {
        return model.activity && !model.activity->tables.empty();
    }

    void show_page(const PanelModel& model) {
        if (model.activity && model.activity->task && !is_empty(picture_)) {
            const ImVec2 screen = ImGui::GetIO().DisplaySize;
            panel::show_task(kit_, *model.activity->task, {{0.0f, 0.0f}, screen});
            return;
        }
        const float margin = kit_.px(16.0f);
        begin_ground(margin, margin);
        if (model.activity && model.activity->task) {
            const ActivityPanel::Task& task = *model.activity->task;
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float width = static_cast<float>(size_.width) - 2.0f * margin;
            const float height = panel::task_height(kit_, task, width);
            panel::draw_task(kit_, task, at, {at.x + width, at.y + height});
            ImGui::Dummy({width, height});
        } else if (model.activity) {
            kit_.paragraph(panel::kText, model.activity->page, kit_.type.text);
        }
        page_height_ = ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y + margin;
        ImGui::End();
    }

    void show_column(const PanelModel& model) {
        const ImVec2 screen{left() + static_cast<float>(size_.width), static_cast<float>(size_.height)};
        const float margin = kit_.px(12.0f);
        begin_ground(margin, kit_.px(8.0f));
        panel::show_header(kit_, model);
        const bool governed = model.activity && model.activity->governs;
        // Ticks and frames are no matter of a person who does an exercise.
        const bool has_plots = model.for_operator || !model.activity || !model.activity->hides_scene;
        const float foot = kit_.px(26.0f + 8.0f + 14.0f + (has_plots ? 56.0f : -8.0f));
        const float footer = foot + (governed ? kit_.px(panel::acts_height(*model.activity)) : 0.0f);
        const ImVec2 top = ImGui::GetCursorScreenPos();
        const ImVec2 inside{ImGui::GetContentRegionAvail().x + 0.8f * margin,
                            ImGui::GetContentRegionAvail().y - footer};
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
        ImGui::BeginChild(model.show_help      ? "help"
                          : model.show_devices ? "devices"
                                               : "sections",
                          inside, false, ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysVerticalScrollbar);
        ImGui::PopStyleVar();
        kit_.visible_lo = top;
        kit_.visible_hi = {top.x + inside.x, top.y + inside.y};
        show_inside(model);
        inside_height_ = ImGui::GetCursorPosY();
        ImGui::EndChild();
        kit_.visible_lo = {left(), 0.0f};
        kit_.visible_hi = screen;
        column_bottom_ = top.y + inside.y;
        if (governed) {
            ImGui::SetCursorScreenPos({left() + margin, screen.y - footer + kit_.px(4.0f)});
            panel::show_acts(kit_, *model.activity);
        }
        ImGui::SetCursorScreenPos({left() + margin, screen.y - foot + kit_.px(4.0f)});
        if (has_plots) panel::show_plots(kit_, model);
        ImGui::SetCursorScreenPos({left() + margin, screen.y - kit_.px(26.0f + 8.0f)});
        panel::show_footer(kit_, model);
        ImGui::End();
    }

    void show_inside(const PanelModel& model) {
        if (model.show_help) {
            panel::show_help(kit_, model);
            return;
        }
        if (model.show_devices) {
            panel::show_devices(kit_, model);
            return;
        }
        if (model.show_figures) panel::show_figures(kit_, model);  // first: whoever turns them on wants to see them
        panel::show_activity(kit_, model);
        const bool governed = model.activity && (model.activity->governs || model.activity->hides_scene);
        const bool for_operator = model.for_operator && has_tables(model);
        if (for_operator) {
            panel::show_log(kit_, model);
            panel::show_tables(kit_, *model.activity);
        }
        if (!governed) {
            panel::show_hands(kit_, model);
            panel::show_tool(kit_, model);
            panel::show_mouse(kit_, model);
            // A mouse alone undoes without scrolling; in a world what is undone was done to its objects.
            if (model.offers_mouse) panel::show_history(kit_, model);
            panel::show_material(kit_, model);
            panel::show_objects(kit_, model);
            if (!model.offers_mouse && !model.carves) panel::show_history(kit_, model);
            panel::show_touch(kit_, model);
            panel::show_workspace(kit_, model);
            panel::show_view(kit_, model);
            if (!model.offers_mouse && model.carves) panel::show_history(kit_, model);
            panel::show_touch_of_others(kit_, model);
        }
        if (!for_operator) panel::show_log(kit_, model);
        panel::show_state(kit_, model);
    }

    ImGuiContext* context_ = nullptr;
    Nanoseconds last_ns_ = 0;
    std::string tip_for_;  // the label that the mouse rests on, and since when
    Nanoseconds tip_from_ns_ = 0;
    float column_bottom_ = 0.0f;                        // of what scrolls
    float inside_height_ = 0.0f, scrolls_over_ = 0.0f;  // of what scrolls, and what its bar is for
};

Panel::Panel(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Panel::Panel(Panel&&) noexcept = default;
Panel& Panel::operator=(Panel&&) noexcept = default;
Panel::~Panel() = default;

Result<Panel> Panel::create(const PanelOptions& options) {
    BURIN_CHECK(options.size.width > 0 && options.size.height > 0 && options.scale > 0.0);
    auto made = std::make_unique<Implementation>(options.size, static_cast<float>(options.scale));
    BURIN_TRY_DO(made->load_letters(options.type_file));
    return Panel(std::move(made));
}

void Panel::resize(ImageSize size) {
    BURIN_CHECK(size.width > 0 && size.height > 0);
    if (size == implementation_->size_) return;
    implementation_->size_ = size;
    implementation_->resting_ = kSettling;
}
Result<void> Panel::rescale(double scale) {
    BURIN_CHECK(scale > 0.0);
    return implementation_->rescale(static_cast<float>(scale));
}
void Panel::lie_over(ImageSize picture) {
    if (picture == implementation_->picture_) return;
    implementation_->picture_ = picture;
    implementation_->resting_ = kSettling;
}
ImageSize Panel::size() const { return implementation_->size_; }
std::uint32_t Panel::page_height() const {
    return static_cast<std::uint32_t>(std::ceil(std::max(implementation_->page_height_, 1.0f)));
}
const renderer::PanelAtlas& Panel::atlas() const { return implementation_->atlas_; }
std::uint64_t Panel::atlases() const { return implementation_->atlases_; }
const std::string& Panel::notice() const { return implementation_->kit_.type.notice; }
std::uint64_t Panel::laid_out() const { return implementation_->laid_out_; }
std::uint64_t Panel::spared() const { return implementation_->spared_; }

void Panel::feed(std::span<const InputEvent> events, const PanelPlace& place) {
    for (const InputEvent& event : events) {
        const Vec2 left_px(static_cast<double>(implementation_->left()), 0.0);
        auto input =
            panel::panel_input(event.input, place.origin_px - left_px * place.px_per_panel_px, place.px_per_panel_px);
        if (input) implementation_->events_.add(std::move(*input));
    }
}

void Panel::point(const std::optional<Vec2>& at_px, bool pressed) {
    Implementation& p = *implementation_;
    if (at_px != p.wand_px_) {
        if (at_px)
            p.events_.add(MouseMove{*at_px + Vec2(static_cast<double>(p.left()), 0.0)});
        else
            p.events_.add(panel::PointerGone{});
    }
    p.wand_px_ = at_px;
    if (pressed != p.wand_pressed_) p.events_.add(MouseClick{MouseButton::left, pressed, {}});
    p.wand_pressed_ = pressed;
}

const PanelFrame& Panel::show(const PanelModel& model, Nanoseconds time_ns) {
    return implementation_->show(model, time_ns);
}

std::optional<PixelRect> Panel::place_of(std::string_view label) const {
    std::optional<PixelRect> at = place_over_picture(label);
    if (at) at->x -= static_cast<std::uint32_t>(implementation_->left());
    return at;
}

std::optional<PixelRect> Panel::place_over_picture(std::string_view label) const {
    const auto at = implementation_->kit_.places.find(label);
    return at == implementation_->kit_.places.end() ? std::nullopt : std::optional(at->second);
}

std::vector<std::string> Panel::labels() const {
    std::vector<std::string> labels;
    for (const auto& [label, place] : implementation_->kit_.places) labels.push_back(label);
    return labels;
}

}  // namespace burin::session
