// SPDX-License-Identifier: MIT
// The panel without any picture: what its widgets say when they are pressed, and that it is the same every time.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "desk/panel/panel.hpp"
#include "desk/panel/panel_sections.hpp"
#include "session/state/command_table.hpp"
#include "tests/desk/panel_models.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::session {
namespace {

constexpr Nanoseconds kFrame_ns = 16'000'000;

// Tall enough that nothing is scrolled away.
struct PanelDesk {
    Panel panel;
    PanelModel model;
    Nanoseconds now_ns = 0;
    std::vector<CommandInput> actions;  // of the last frame

    explicit PanelDesk(PanelModel shown, ImageSize size = {340, 1600})
        : panel(std::move(Panel::create({.size = size}).value())), model(std::move(shown)) {
        show();
    }
    void show() {
        actions = panel.show(model, now_ns).actions;
        now_ns += kFrame_ns;
    }
    void send(std::vector<Input> inputs) {
        std::vector<InputEvent> events;
        for (Input& input : inputs) events.push_back({now_ns, std::move(input)});
        panel.feed(events);
        show();
    }
    Vec2 middle_of(std::string_view label) {
        const auto at = panel.place_of(label);
        EXPECT_TRUE(at) << label << " is not shown";
        return at ? Vec2(at->x + 0.5 * at->width, at->y + 0.5 * at->height) : Vec2(-1.0);
    }
    // All within one frame, as a quick finger does it.
    std::vector<CommandInput> click(std::string_view label) {
        send({MouseMove{middle_of(label)}, MouseClick{MouseButton::left, true, {}},
              MouseClick{MouseButton::left, false, {}}});
        return actions;
    }
};

using Commands = std::vector<CommandInput>;

// What each widget but those of the tools says when its middle is pressed, of the model of a tool at rest.
const std::map<std::string, Commands>& fixed_commands() {
    static const std::map<std::string, Commands> expected = {
        {"operation cut", {{"operation", {"cut"}}}},
        {"operation fill", {{"operation", {"fill"}}}},
        {"operation paint", {{"operation", {"paint"}}}},
        {"operation smooth", {{"operation", {"smooth"}}}},
        {"colour 1", {{"colour", {"0.8,0.76,0.7"}}}},
        {"colour 2", {{"colour", {"0.88,0.56,0.21"}}}},
        {"colour 3", {{"colour", {"0.7,0.34,0.22"}}}},
        {"colour 4", {{"colour", {"0.62,0.22,0.3"}}}},
        {"colour 5", {{"colour", {"0.38,0.62,0.48"}}}},
        {"colour 6", {{"colour", {"0.26,0.41,0.77"}}}},
        {"colour 7", {{"colour", {"0.44,0.38,0.64"}}}},
        {"colour 8", {{"colour", {"0.36,0.38,0.4"}}}},
        {"colour", {}},  // opens
        {"material", {}},
        {"force", {{"force", {"off"}}}},
        {"technique", {}},
        {"stereo-mode", {}},
        {"swap-eyes", {{"swap-eyes", {"on"}}}},
        {"edge-comfort", {{"edge-comfort", {"off"}}}},
        {"show-force", {{"show-force", {"on"}}}},
        {"test-pattern none", {{"test-pattern", {"none"}}}},
        {"test-pattern eye_order", {{"test-pattern", {"eye_order"}}}},
        {"test-pattern ghosting", {{"test-pattern", {"ghosting"}}}},
        {"test-pattern geometry", {{"test-pattern", {"geometry"}}}},
        {"undo", {{"undo", {}}}},
        {"redo", {{"redo", {}}}},
        {"path", {}},
        {"export", {{"export", {"part.stl"}}}},
        {"toggle-help", {{"toggle-help", {}}}},
        {"toggle-frame-figures", {{"toggle-frame-figures", {}}}},
        {"toggle-panel", {{"toggle-panel", {}}}},
        {"quit", {{"quit", {}}}},
        // Cards open and close.
        {"Tool", {}},
        {"Material", {}},
        {"Touch", {}},
        {"Workspace", {}},
        {"View", {}},
        {"History and export", {}},
        {"Messages", {}},
        {"State", {}}};
    return expected;
}

std::vector<toolbox::ToolKind> kinds_on_panel() {
    std::vector<toolbox::ToolKind> kinds;
    for (const toolbox::ToolDescriptor& kind : toolbox::tool_kinds())
        if (kind.on_panel()) kinds.push_back(kind.kind);
    return kinds;
}

// Another kind of tool than the model's is given in about its size (PanelSizes, below).
std::map<std::string, Commands> expected_commands() {
    std::map<std::string, Commands> expected = fixed_commands();
    for (const char* axis : {"x", "y", "z"}) expected[std::string("mirror ") + axis] = {{"mirror", {axis}}};
    const toolbox::ToolSpec held = idle_model().tool;
    for (const toolbox::ToolKind kind : kinds_on_panel()) {
        Commands& given = expected["tool " + std::string(toolbox::descriptor_of(kind).name)];
        if (kind != held.kind) given = {{"tool", {toolbox::text_of(panel::tool_like(held, kind))}}};
    }
    return expected;
}

// Their middle is the middle of their range.
const std::set<std::string> kSliders{"radius",          "hardness",     "stiffness", "friction",
                                     "velocity-filter", "force-filter", "scale",     "eye-distance"};

PanelModel workable_model() {
    PanelModel model = idle_model();
    model.undo_count = 3;
    model.redo_count = 1;
    model.hardness_Ns_per_m3 = 3e6;  // not the middle
    model.stereo_mode = wall::StereoMode::anaglyph_red_cyan;
    model.tool_sizes = tool_sizes_for(0.05);
    model.fades_at_edges = true;
    return model;
}

TEST(PanelWidgets, GiveExactlyTheirCommandWhenClicked) {
    const std::map<std::string, Commands> all = expected_commands();
    std::set<std::string> seen;
    for (const std::string& label : PanelDesk(workable_model()).panel.labels()) {
        PanelDesk desk(workable_model());
        const Commands given = desk.click(label);
        seen.insert(label);
        if (kSliders.contains(label)) {
            ASSERT_EQ(given.size(), 1u) << label;
            EXPECT_EQ(given[0].name, label);
            const auto command = parse_command(given[0]);
            ASSERT_TRUE(command) << command.error().line();
            const auto& quantity = std::get<SetQuantity>(*command);
            const QuantityDescriptor& range = descriptor_of(quantity.quantity);
            const ToolSizeRange& sizes = desk.model.tool_sizes;
            const double from = label == "radius" ? sizes.from_m : range.from;
            const double to = label == "radius" ? 2.0 * sizes.radius_to_m : range.to;
            const double middle = range.by_ratio ? std::sqrt(from * to) : 0.5 * (from + to);
            EXPECT_NEAR(quantity.value, middle, 0.06 * middle) << label;
            continue;
        }
        const auto expected = all.find(label);
        ASSERT_NE(expected, all.end()) << label << " is in no table of this test";
        EXPECT_EQ(given, expected->second) << label;
        for (const CommandInput& action : given) EXPECT_TRUE(parse_command(action)) << label;
    }
    for (const auto& [label, commands] : all) EXPECT_TRUE(seen.contains(label)) << label;
    for (const std::string& label : kSliders) EXPECT_TRUE(seen.contains(label)) << label;
}

TEST(PanelWidgets, OfferEveryEntryOfTheirLists) {
    const auto offers = [](const std::string& list, std::string_view entry) {
        PanelDesk desk(workable_model());
        (void)desk.click(list.c_str());
        EXPECT_EQ(desk.click(list + " " + std::string(entry)), (Commands{{list, {std::string(entry)}}}));
    };
    for (const wall::StereoMode mode : wall::stereo_modes()) offers("stereo-mode", file_name_of(mode));
    for (const auto& preset : toolbox::feel_presets()) offers("material", preset.name);
    for (const TechniqueDescriptor& technique : techniques()) offers("technique", technique.name);
}

TEST(PanelWidgets, SaySizesOfEveryToolThatATakerTakes) {
    for (const toolbox::ToolKind kind : kinds_on_panel()) {
        PanelModel model = workable_model();
        model.tool = panel::tool_like(model.tool, kind);
        for (const toolbox::ToolSize& size : toolbox::descriptor_of(kind).used_sizes()) {
            const std::string label = size.name == "radius" ? "radius" : "tool " + std::string(size.name);
            PanelDesk desk(model);
            const Commands given = desk.click(label);
            ASSERT_EQ(given.size(), 1u) << label;
            EXPECT_EQ(given[0].name, kind == toolbox::ToolKind::ball ? "radius" : "tool");
            EXPECT_TRUE(parse_command(given[0])) << label;
        }
    }
}

TEST(PanelWidgets, ThatAreOffGiveNothing) {
    PanelModel model = workable_model();
    model.undo_count = model.redo_count = 0;
    model.exporting = true;
    for (const char* label : {"undo", "redo", "export"}) {
        PanelDesk desk(model);
        EXPECT_TRUE(desk.click(label).empty()) << label;
    }
}

TEST(PanelWidgets, GiveNothingWhenTheHandSlipsOffBeforeRelease) {
    PanelDesk desk(workable_model());
    desk.send({MouseMove{desk.middle_of("quit")}, MouseClick{MouseButton::left, true, {}}});
    desk.send({MouseMove{desk.middle_of("State")}});
    desk.send({MouseClick{MouseButton::left, false, {}}});
    EXPECT_TRUE(desk.actions.empty());
}

TEST(PanelSlider, GivesAValueOnceWhileTheHandRests) {
    PanelDesk desk(workable_model());
    const auto at = *desk.panel.place_of("friction");
    const auto place = [&](double part) { return Vec2(at.x + part * at.width, at.y + 0.5 * at.height); };
    desk.send({MouseMove{place(0.5)}, MouseClick{MouseButton::left, true, {}}});
    EXPECT_EQ(desk.actions.size(), 1u);
    // The session has not followed yet: nothing is said twice.
    for (int i = 0; i < 5; ++i) desk.send({MouseMove{place(0.5)}});
    EXPECT_TRUE(desk.actions.empty());
    double last = 0.0;
    for (const double part : {0.6, 0.7, 0.8, 0.9}) {
        desk.send({MouseMove{place(part)}});
        ASSERT_EQ(desk.actions.size(), 1u) << part;
        const double value = std::get<SetQuantity>(*parse_command(desk.actions[0])).value;
        EXPECT_GT(value, last);
        last = value;
    }
    // Beyond the end it stays at the end.
    desk.send({MouseMove{place(5.0)}});
    ASSERT_EQ(desk.actions.size(), 1u);
    EXPECT_EQ(desk.actions[0], (CommandInput{"friction", {"1"}}));
    desk.send({MouseClick{MouseButton::left, false, {}}});
    desk.send({MouseMove{place(0.2)}});
    EXPECT_TRUE(desk.actions.empty());
}

TEST(PanelAtRest, IsNotLaidOutAgainForBeingToldItsSize) {
    PanelDesk desk(workable_model());
    for (int i = 0; i < 10; ++i) desk.show();  // until it rests
    const std::uint64_t before = desk.panel.laid_out();
    for (int i = 0; i < 10; ++i) {
        desk.panel.resize(desk.panel.size());
        desk.show();
    }
    EXPECT_EQ(desk.panel.laid_out(), before);
    desk.panel.resize({340, 1500});
    desk.show();
    EXPECT_GT(desk.panel.laid_out(), before);
}

TEST(PanelCard, KeepsWhatIsBesideItsTitleOffTheTitle) {
    const auto letters_of_title = [](haptics::WorkspacePhase phase) {
        PanelModel model = workable_model();
        model.phase = phase;
        PanelDesk desk(model);
        const PixelRect card = *desk.panel.place_of("Workspace");
        const double top = card.y, bottom = top + card.height, right = card.x + 96.0;
        const renderer::PanelMesh& mesh = desk.panel.show(model, desk.now_ns).mesh;
        return std::ranges::count_if(
            mesh.vertices, [&](const renderer::PanelVertex& v) { return v.x < right && v.y > top && v.y < bottom; });
    };
    for (std::size_t i = 0; i <= static_cast<std::size_t>(haptics::WorkspacePhase::gliding); ++i)
        EXPECT_EQ(letters_of_title(static_cast<haptics::WorkspacePhase>(i)),
                  letters_of_title(haptics::WorkspacePhase::editing))
            << i;
}

TEST(PanelText, IsTypedIntoThePathAndExportedByEnter) {
    PanelDesk desk(workable_model());
    (void)desk.click("path");
    EXPECT_TRUE(desk.panel.show(desk.model, desk.now_ns).wants_keyboard);
    desk.send({KeyInput{Key::a, KeyMotion::press, {.ctrl = true}}, KeyInput{Key::a, KeyMotion::release, {.ctrl = true}},
               KeyInput{Key::ctrl, KeyMotion::release, {}}, TextInput{"bowl"}, TextInput{".ply"},
               KeyInput{Key::enter, KeyMotion::press, {}}, KeyInput{Key::enter, KeyMotion::release, {}}});
    ASSERT_EQ(desk.actions.size(), 1u);
    EXPECT_EQ(desk.actions[0].arguments, std::vector<std::string>{"bowl.ply"});
    desk.show();
    EXPECT_FALSE(desk.panel.show(desk.model, desk.now_ns).wants_keyboard);
}

TEST(PanelMouse, IsWantedOverThePanelOnly) {
    PanelDesk desk(workable_model());
    desk.send({MouseMove{{170.0, 300.0}}});
    EXPECT_TRUE(desk.panel.show(desk.model, desk.now_ns).wants_mouse);
    desk.send({MouseMove{{-20.0, 300.0}}});
    EXPECT_FALSE(desk.panel.show(desk.model, desk.now_ns).wants_mouse);
}

TEST(PanelMouse, IsFoundWhereThePanelIsInTheOutput) {
    PanelDesk desk(workable_model());
    const Vec2 at = desk.middle_of("undo");
    const PanelPlace place{{900.0, 40.0}, {0.5, 1.0}};  // as in side by side, half width
    const Vec2 output = place.origin_px + at * place.px_per_panel_px;
    const std::array<InputEvent, 3> events{{{0, MouseMove{output}},
                                            {0, MouseClick{MouseButton::left, true, {}}},
                                            {0, MouseClick{MouseButton::left, false, {}}}}};
    desk.panel.feed(events, place);
    desk.show();
    EXPECT_EQ(desk.actions, (Commands{{"undo", {}}}));
}

TEST(PanelWand, PressesWhatItPointsAt) {
    PanelDesk desk(workable_model());
    const Vec2 at = desk.middle_of("operation fill");
    desk.panel.point(at, true);
    desk.show();
    EXPECT_TRUE(desk.actions.empty());
    desk.panel.point(at, false);
    desk.show();
    EXPECT_EQ(desk.actions, (Commands{{"operation", {"fill"}}}));
    desk.panel.point(std::nullopt, true);  // the trigger, pointed elsewhere, is not the panel's
    desk.show();
    EXPECT_TRUE(desk.actions.empty());
    EXPECT_FALSE(desk.panel.show(desk.model, desk.now_ns).wants_mouse);
}

TEST(PanelWheel, BringsUpWhatIsBelow) {
    PanelDesk desk(workable_model(), {340, 500});
    EXPECT_FALSE(desk.panel.place_of("export"));
    for (int i = 0; i < 40; ++i) desk.send({MouseMove{{170.0, 250.0}}, Scroll{{0.0, -1.0}, {}}});
    EXPECT_TRUE(desk.panel.place_of("State"));
    EXPECT_FALSE(desk.panel.place_of("tool ball"));
}

TEST(PanelRest, LaysNothingOutWhileNothingChanges) {
    PanelDesk desk(workable_model());
    for (int i = 0; i < 5; ++i) desk.show();
    const std::uint64_t before = desk.panel.laid_out();
    for (int i = 0; i < 100; ++i) {
        const PanelFrame& frame = desk.panel.show(desk.model, desk.now_ns += kFrame_ns);
        EXPECT_FALSE(frame.changed);
        EXPECT_FALSE(frame.mesh.indices.empty());
    }
    EXPECT_EQ(desk.panel.laid_out(), before);
    desk.model.undo_count = 4;
    EXPECT_TRUE(desk.panel.show(desk.model, desk.now_ns).changed);
}

// A page that is broken into other lines changes the height of what scrolls. The bar kept the length that fitted the
// page before, for as long as nothing else changed, so that pictures of the same state differed.
TEST(PanelRest, LooksTheSameWhateverPageCameBefore) {
    const auto after = [](const std::string& before) {
        PanelDesk desk(workable_model(), {340, 680});
        desk.model.activity = ActivityPanel{.title = "Study"};
        for (int i = 0; i < 5; ++i) desk.show();
        for (const std::string& page : {before, std::string("wrote part.stl")}) {
            desk.model.activity->page = page;
            desk.show();
        }
        return desk.panel.show(desk.model, desk.now_ns).mesh;
    };
    EXPECT_TRUE(after("wrote it") == after("wrote a file in a folder with a name so long that it takes several lines"));
}

TEST(PanelHidden, IsEmptyAndWantsNothing) {
    PanelDesk desk(workable_model());
    const Vec2 at = desk.middle_of("quit");
    desk.model.visible = false;
    desk.send({MouseMove{at}, MouseClick{MouseButton::left, true, {}}, MouseClick{MouseButton::left, false, {}}});
    EXPECT_TRUE(desk.actions.empty());
    const PanelFrame& frame = desk.panel.show(desk.model, desk.now_ns);
    EXPECT_TRUE(frame.mesh.draws.empty());
    EXPECT_FALSE(frame.wants_mouse);
}

TEST(PanelType, ThatCannotBeUsedIsNamed) {
    for (const char* file : {"no/such/type.ttf", "README.md"}) {
        const auto panel = Panel::create({.type_file = file});
        ASSERT_FALSE(panel);
        EXPECT_TRUE(panel.error().line().contains(file));
    }
}

TEST(PanelHelp, NamesEveryKeyAndCommand) {
    PanelDesk desk(help_model());
    EXPECT_TRUE(desk.panel.place_of("Keys"));
    EXPECT_FALSE(desk.panel.place_of("tool ball"));
    EXPECT_EQ(desk.click("toggle-help"), (Commands{{"toggle-help", {}}}));
}

Input random_input(std::mt19937& random) {
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    switch (below(8)) {
        case 0:
        case 1: return MouseClick{MouseButton::left, below(2) == 0, {}};
        case 2: return Scroll{{0.0, below(7) - 3}, {}};
        case 3:
            return KeyInput{static_cast<Key>(below(static_cast<int>(kKeyCount))),
                            static_cast<KeyMotion>(below(3)),
                            {.shift = below(2) == 0, .ctrl = below(2) == 0}};
        case 4: return TextInput{std::array{"a", "\xC3\xA9", "x.stl", ""}.at(static_cast<std::size_t>(below(4)))};
        case 5: return WindowFocus{below(2) == 0};
        default: return MouseMove{{below(360) - 10, below(920) - 10}};
    }
}

// Every mesh can be painted, every action can be run.
void expect_sound(const PanelFrame& frame, ImageSize size) {
    for (const std::uint32_t i : frame.mesh.indices) ASSERT_LT(i, frame.mesh.vertices.size());
    for (const renderer::PanelDraw& draw : frame.mesh.draws) {
        EXPECT_LE(draw.first_index + draw.index_count, frame.mesh.indices.size());
        EXPECT_LE(draw.clip.x + draw.clip.width, size.width);
        EXPECT_LE(draw.clip.y + draw.clip.height, size.height);
    }
    for (const CommandInput& action : frame.actions) EXPECT_TRUE(parse_command(action)) << action.name;
}

TEST(PanelReplay, IsTheSameBitForBitWhateverOtherPanelsDo) {
    const ImageSize size{340, 900};
    const std::array<PanelModel, 3> models{carving_model(), no_force_model(), help_model()};
    std::size_t actions = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        std::mt19937 random(seed);
        auto one = Panel::create({.size = size}), two = Panel::create({.size = size});
        auto other = Panel::create({.size = {400, 500}, .scale = 1.3});
        for (Nanoseconds now_ns = 0; now_ns < 40 * kFrame_ns; now_ns += kFrame_ns) {
            std::vector<InputEvent> events;
            for (unsigned i = random() % 8; i > 0; --i) events.push_back({now_ns, random_input(random)});
            const PanelModel& model = models[random() % 16 == 0 ? random() % 3 : 0];
            one->feed(events);
            two->feed(events);
            const PanelFrame& a = one->show(model, now_ns);
            (void)other->show(models[random() % 3], now_ns);
            const PanelFrame& b = two->show(model, now_ns);
            ASSERT_TRUE(a.mesh == b.mesh) << seed;
            ASSERT_EQ(a.actions, b.actions) << seed;
            ASSERT_EQ(a.changed, b.changed) << seed;
            ASSERT_EQ(a.wants_mouse, b.wants_mouse) << seed;
            ASSERT_EQ(a.wants_keyboard, b.wants_keyboard) << seed;
            expect_sound(a, size);
            actions += a.actions.size();
        }
    }
    EXPECT_GT(actions, 5u) << "hardly anything was pressed";
}

RC_GTEST_PROP(PanelSizes, OfAnyToolStayATool, ()) {
    const auto any_kind = [] { return *rc::gen::elementOf(kinds_on_panel()); };
    toolbox::ToolSpec tool{toolbox::ToolKind::ball, {0.001 * *rc::gen::inRange(1, 100), 0.0, 0.0}, {}};
    tool = panel::tool_like(tool, any_kind());
    for (int i = 0; i < 4; ++i) {
        const auto sizes = toolbox::descriptor_of(tool.kind).used_sizes().size();
        const double size_m = panel::value_at(0.01 * *rc::gen::inRange(0, 101), 0.0005, 0.1, true);
        tool = panel::with_size(tool, *rc::gen::inRange<std::size_t>(0, sizes), size_m);
        RC_ASSERT(toolbox::parse_tool_settings({.shape = toolbox::text_of(tool)}).has_value());
        tool = panel::tool_like(tool, any_kind());
    }
}

TEST(PanelSizes, OfAnotherKindAreAboutAsWide) {
    using toolbox::ToolKind;
    const auto like = [](const toolbox::ToolSpec& tool, ToolKind kind) {
        return toolbox::text_of(panel::tool_like(tool, kind));
    };
    const toolbox::ToolSpec ball{ToolKind::ball, {0.004, 0.0, 0.0}, {}};
    EXPECT_EQ(like(ball, ToolKind::cylinder), "cylinder:0.004,0.016");
    EXPECT_EQ(like(ball, ToolKind::cone), "cone:0,0.004,0.012");
    EXPECT_EQ(like(ball, ToolKind::bullnose), "bullnose:0.004,0.001,0.016");
    EXPECT_EQ(like(ball, ToolKind::box), "box:0.008,0.008,0.008");
    EXPECT_EQ(like({ToolKind::box, {0.02, 0.5, 0.7}, {}}, ToolKind::ball), "ball:0.01");
    EXPECT_EQ(like({ToolKind::cone, {0.5, 0.03, 0.7}, {}}, ToolKind::ball), "ball:0.03");
    EXPECT_EQ(like({ToolKind::mesh, {}, "a.stl"}, ToolKind::ball), "ball:0.005");
    EXPECT_EQ(like(ball, ToolKind::mesh), "ball:0.004") << "which the panel does not offer";
    for (const ToolKind kind : kinds_on_panel())
        EXPECT_EQ(like(panel::tool_like(ball, kind), ToolKind::ball), "ball:0.004");
}

TEST(PanelSizes, ThatAreOfferedSuitTheWorkpiece) {
    const ToolSizeRange usual = tool_sizes_for(0.2);  // as the panel has always had them, for a ball of 100 mm
    EXPECT_DOUBLE_EQ(usual.from_m, ToolSizeRange{}.from_m);
    EXPECT_DOUBLE_EQ(usual.radius_to_m, ToolSizeRange{}.radius_to_m);
    EXPECT_DOUBLE_EQ(tool_sizes_for(0.05).radius_to_m, 0.0125);
    EXPECT_DOUBLE_EQ(tool_sizes_for(0.05).from_m, 0.000125);
    for (const double longest_side_m : {1e-9, 1e-4, 50.0, 1e6}) {
        const ToolSizeRange range = tool_sizes_for(longest_side_m);
        EXPECT_GE(range.from_m, descriptor_of(Quantity::radius).least);
        EXPECT_LT(range.from_m, range.radius_to_m);
        EXPECT_LE(2.0 * range.radius_to_m, descriptor_of(Quantity::radius).most);
    }
}

TEST(PanelSizes, FollowTheOneThatIsSet) {
    using toolbox::ToolKind;
    const toolbox::ToolSpec nose{ToolKind::bullnose, {0.004, 0.001, 0.016}, {}};
    EXPECT_EQ(panel::with_size(nose, 1, 0.02).sizes_m, (toolbox::ToolSizes{0.02, 0.02, 0.02}));
    EXPECT_EQ(panel::with_size(nose, 0, 0.0005).sizes_m, (toolbox::ToolSizes{0.0005, 0.0005, 0.016}));
    const toolbox::ToolSpec cone{ToolKind::cone, {0.0, 0.004, 0.012}, {}};
    EXPECT_EQ(panel::with_size(cone, 1, 0.0).sizes_m, (toolbox::ToolSizes{0.0005, 0.0, 0.012}));
    EXPECT_EQ(panel::with_size(cone, 0, 0.002).sizes_m, (toolbox::ToolSizes{0.002, 0.004, 0.012}));
}

}  // namespace
}  // namespace burin::session
