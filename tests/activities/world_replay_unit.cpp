// SPDX-License-Identifier: MIT
// Recorded explorations: which object a tick touches, settings as text, and doing ticks again.
#include "activities/replay/old_exploration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "activities/world/felt_through.hpp"
#include "activities/world/felt_world.hpp"
#include "record/compare.hpp"
#include "scene/world_file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::activities {
namespace {

std::shared_ptr<const geometry::TriangleMesh> replayed_cube(double half_m) {
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    for (int i = 0; i < 8; ++i)
        mesh->positions_m.emplace_back((i & 1) != 0 ? half_m : -half_m, (i & 2) != 0 ? half_m : -half_m,
                                       (i & 4) != 0 ? half_m : -half_m);
    mesh->triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

// Cubes whose tops are at y = 0, 30 mm apart, that share one mesh and stand where their poses say; of the third the
// mesh itself is elsewhere and its pose none, as a VRML world has it. The second moves up and down.
std::vector<scene::SceneObject> three_cubes() {
    std::vector<scene::SceneObject> objects(3);
    const auto mesh = replayed_cube(0.01);
    auto moved = std::make_shared<geometry::TriangleMesh>(*mesh);
    for (Vec3& p : moved->positions_m) p += Vec3(0.06, -0.01, 0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        objects[i].id = i + 1;
        objects[i].name = "cube " + std::to_string(i + 1);
        objects[i].mesh = i < 2 ? mesh : moved;
        if (i < 2) objects[i].pose.position_m = {0.03 * static_cast<double>(i), -0.01, 0.0};
        objects[i].material = {.stiffness_N_per_m = 300.0, .damping_Ns_per_m = 0.3, .static_friction = 0.2};
    }
    objects[1].motion = scene::PathMotion{{{0.0, {}}, {0.5, {{0.0, 0.002, 0.0}}}, {1.0, {}}}, true};
    return objects;
}

ExploredWorld cube_world() {
    return {.scene = std::make_shared<const scene::World>(scene::World{"cubes", three_cubes(), {}})};
}

// Presses on each cube for half a second, and records it.
void record_cubes(const std::string& path, double radius_m = 0.004) {
    sculpt::Stroke stroke;
    for (int i = 0; i < 3; ++i)
        for (const auto& [t, y] : {std::pair(0.0, 0.015), std::pair(0.3, 0.001), std::pair(0.8, 0.001)})
            stroke.push_back({i + t, {0.03 * i, y, 0.0}, Quat{1, 0, 0, 0}, false});
    ExploreOptions options;
    options.tool_radius_m = radius_m;
    ExploredWorld world = cube_world();
    world.record = path;
    const auto done = explore_by_feel(world, stroke, options, {});
    ASSERT_TRUE(done) << done.error().line();
}

// An exploration that was recorded before explorations were sessions.
Result<record::Comparison> replayed(const std::string& path, const record::TickRange& range = {}) {
    Result<record::RecordReader> reader = record::RecordReader::open(path);
    if (!reader) return std::unexpected(reader.error());
    return replay_old_exploration(*reader, "tests/activities/old/cube.wrl", range);
}

// Copies such a recording; the ticks are of this compiler's program.
void take_old(const std::string& name, const std::string& to) {
    std::filesystem::copy_file("tests/activities/old/" + name, to);
}
bool is_of_another_compiler(const std::string& path) {
    const auto reader = record::RecordReader::open(path);
    return !reader || reader->fact("compiler") != __VERSION__;
}

// Changes one value of one tick of a recording, and its block's check sum with it.
void change_value(const std::string& path, std::int64_t tick, const std::string& column, double value) {
    auto reader = record::RecordReader::open(path);
    ASSERT_TRUE(reader);
    const record::HandRecord& hand = reader->hands()[0];
    const std::size_t at = record::find_column(hand, column, record::ColumnType::f64);
    ASSERT_LT(at, hand.columns.size());
    for (std::size_t number = 0; number < hand.blocks.size(); ++number) {
        const record::BlockPlace& place = hand.blocks[number];
        if (tick < place.header.tick0 || tick >= place.header.tick0 + place.header.rows) continue;
        const auto block = reader->block(0, number);
        ASSERT_TRUE(block);
        record::Block changed(hand.types());
        for (std::uint32_t row = 0; row < block->rows(); ++row) {
            std::vector<record::Word> words;
            for (std::size_t c = 0; c < block->columns(); ++c) words.push_back(block->at(c, row));
            if (place.header.tick0 + row == tick) words[at] = std::bit_cast<record::Word>(value);
            changed.add(words);
        }
        const auto packed = record::pack(changed, place.header);
        ASSERT_TRUE(packed);
        auto database = record::Database::open(path, record::Database::Use::write);
        auto update = database->prepare("UPDATE block SET data = ?, crc = ? WHERE id = ?");
        update->bind(1, std::span<const std::byte>(packed->data));
        update->bind(2, std::int64_t{packed->crc});
        update->bind(3, place.id);
        ASSERT_TRUE(update->run());
    }
}

}  // namespace

TEST(RecordedCubes, AreTouchedOneAfterTheOtherHoweverTheyShareMeshes) {
    const Workplace at;
    record_cubes(at / "a.session");
    auto reader = record::RecordReader::open(at / "a.session");
    ASSERT_TRUE(reader) << reader.error().line();
    ASSERT_EQ(reader->hands()[0].objects.size(), 3u);
    EXPECT_EQ(reader->hands()[0].objects[2].name, "cube 3");
    const std::size_t object = record::find_column(reader->hands()[0], "object0", record::ColumnType::u32);
    std::vector<record::Word> order;
    record::RowWalk walk(*reader, 0);
    while (*walk.next())
        if (walk.at(object) != 0 && (order.empty() || order.back() != walk.at(object)))
            order.push_back(walk.at(object));
    EXPECT_EQ(order, (std::vector<record::Word>{1, 2, 3}));
}

TEST(OldExploration, IsEqualWithStylusAndWandAndAChangedValueOfOneTickIsNamed) {
    const Workplace at;
    for (const auto& [name, columns] : {std::pair("omni.session", 80u), std::pair("wand.session", 100u)}) {
        const std::string path = at / name;
        take_old(name, path);
        if (is_of_another_compiler(path)) GTEST_SKIP() << "another compiler's program adds up in another order";
        const auto same = replayed(path);
        ASSERT_TRUE(same) << same.error().line();
        ASSERT_FALSE(same->difference) << name << ": " << same->difference->line();
        EXPECT_EQ(same->ticks, 1100u);
        EXPECT_EQ(same->columns, columns);
        change_value(path, 700, "desired_force_device_y_N", 0.25);
        const auto changed = replayed(path);
        ASSERT_TRUE(changed && changed->difference);
        EXPECT_EQ(changed->difference->tick, 700);
        EXPECT_EQ(changed->difference->column, "desired_force_device_y_N");
        EXPECT_EQ(changed->difference->first, "0.25");
        EXPECT_EQ(changed->ticks, 699u);
        EXPECT_FALSE(replayed(path, {701, 9999})->difference) << "the value is no input of the next tick";
        EXPECT_EQ(replayed(path, {.to = 699})->ticks, 699u);
    }
}

// What the hand did in one tick decides later ones: the first difference is there, or soon after.
TEST(OldExploration, AChangedSampleChangesWhatIsFelt) {
    const Workplace at;
    take_old("omni.session", at / "a");
    if (is_of_another_compiler(at / "a")) GTEST_SKIP() << "another compiler's program adds up in another order";
    change_value(at / "a", 900, "position_device_y_m", -0.001);
    const auto changed = replayed(at / "a");
    ASSERT_TRUE(changed && changed->difference);
    EXPECT_GE(changed->difference->tick, 900);
    EXPECT_LT(changed->difference->tick, 905);
}

TEST(OldExploration, NumbersThatNoTickHasAreRefusedOrFeltAsNothing) {
    const Workplace at;
    take_old("omni.session", at / "a");
    change_value(at / "a", 700, "object_from_device_scale", std::nan(""));
    const auto no_map = replayed(at / "a");
    ASSERT_FALSE(no_map);
    EXPECT_NE(no_map.error().line().find("tick 700 has a time or a mapping that no tick has"), std::string::npos);
    take_old("omni.session", at / "b");
    change_value(at / "b", 700, "position_device_x_m", std::nan(""));
    const auto no_place = replayed(at / "b");
    ASSERT_TRUE(no_place && no_place->difference) << "the tick of it has no force";
}

// The same motion recorded today has the same ticks: explorations became sessions, and nothing that is felt is another.
TEST(OldExploration, HasTheTicksThatASessionHas) {
    const Workplace at;
    const std::string folder = std::filesystem::absolute("tests/activities/old").string();
    if (is_of_another_compiler(folder + "/omni.session")) GTEST_SKIP() << "another compiler's program";
    for (const auto& [name, stroke, device] :
         {std::tuple("omni", "press", "simulated"), std::tuple("wand", "press-wand", "simulated-wand")}) {
        const std::string path = at / (std::string(name) + ".session");
        const auto felt = at.run(std::string(kBurinCommand) + " world '" + folder + "/cube.wrl' --stroke '" + folder +
                                 "/" + stroke + ".csv' --device " + device + " --record '" + path + "'");
        ASSERT_EQ(felt.status, 0) << felt.output;
        auto was = record::RecordReader::open(folder + "/" + name + ".session"), is = record::RecordReader::open(path);
        ASSERT_TRUE(was && is);
        const auto found =
            record::compare(*was, *is, "proxy0_*,desired_*,commanded_*,surface_sequence,triangle0,object0,flags");
        ASSERT_TRUE(found) << found.error().line();
        EXPECT_FALSE(found->difference) << name << ": " << found->difference->line();
        EXPECT_EQ(found->ticks, 1100u);
    }
}

TEST(FeltThrough, AMotionThatBeginsLaterBeginsWithAProxyOfItsOwn) {
    const Workplace at;
    record_cubes(at / "a.session");
    const auto felt = [&](const record::TickRange& range, double radius_m) {
        auto reader = record::RecordReader::open(at / "a.session");
        std::vector<std::vector<record::Word>> rows;
        const auto figures = feel_through(*reader, cube_world(), {{}, radius_m}, range,
                                          [&](const record::RecordedTick&, const std::vector<record::Word>& row) {
                                              rows.push_back(row);
                                              return Result<void>();
                                          });
        EXPECT_TRUE(figures) << figures.error().line();
        return std::pair(*figures, rows);
    };
    const auto [all, all_rows] = felt({}, 0.004);
    EXPECT_EQ(all.ticks, 3400u);
    ASSERT_EQ(all.points.size(), 1u);
    EXPECT_EQ(all.points[0].proxy_deviation_max_m, 0.0);
    EXPECT_EQ(all.force_deviation_max_N, 0.0);
    EXPECT_EQ(all.points[0].first_contact, "cube 1");
    EXPECT_EQ(all.points[0].ticks_in_contact, all.ticks_in_contact);
    EXPECT_EQ(all_rows.front().size(), through_columns().size());
    EXPECT_EQ(felt({}, 0.004).second, all_rows) << "twice gives the same bits";
    const auto [late, late_rows] = felt({2000, 2500}, 0.004);
    EXPECT_EQ(late.first_tick, 2000);
    EXPECT_EQ(late_rows.size(), 501u);
    const auto [small, small_rows] = felt({}, 0.002);
    EXPECT_GT(small.force_deviation_max_N, 0.1) << "a smaller ball is pressed in less deeply";
    EXPECT_LT(small.force_max_N, all.force_max_N);
}

// Programs of others read these by name.
TEST(FeltThrough, ATableOfOnePointKeepsItsColumnsAndAWandHasThemForEachPoint) {
    const auto names = [](const DeviceAsRecorded& device) {
        std::vector<std::string> names;
        for (const record::Column& column : through_columns(device)) names.push_back(column.name);
        return names;
    };
    const std::vector<std::string> omni{"tick",
                                        "time_ns",
                                        "proxy0_object_x_m",
                                        "proxy0_object_y_m",
                                        "proxy0_object_z_m",
                                        "force0_device_x_N",
                                        "force0_device_y_N",
                                        "force0_device_z_N",
                                        "penetration0_m",
                                        "triangle0",
                                        "object0",
                                        "desired_force_device_x_N",
                                        "desired_force_device_y_N",
                                        "desired_force_device_z_N",
                                        "commanded_force_device_x_N",
                                        "commanded_force_device_y_N",
                                        "commanded_force_device_z_N",
                                        "flags",
                                        "cause",
                                        "proxy0_deviation_m",
                                        "commanded_force_deviation_N"};
    EXPECT_EQ(names({}), omni);
    const devices::WandDescription wand;
    const std::vector<std::string> two = names({wand, wand.points});
    EXPECT_EQ(two.size(), omni.size() + 9 + 1 + 6 + 1) << "a point, its deviation, torques, their deviation";
    for (const char* name : {"proxy1_object_z_m", "force1_device_x_N", "object1", "proxy1_deviation_m",
                             "desired_torque_device_z_Nm", "commanded_torque_deviation_Nm"})
        EXPECT_TRUE(std::ranges::find(two, name) != two.end()) << name;
}

TEST(FeltThrough, EndsWhereARowIsNotTaken) {
    const Workplace at;
    record_cubes(at / "a.session");
    auto reader = record::RecordReader::open(at / "a.session");
    const auto figures =
        feel_through(*reader, cube_world(), {}, {}, [](const record::RecordedTick& tick, const auto&) -> Result<void> {
            if (tick.tick < 100) return {};
            return fail("disk", "is full");
        });
    ASSERT_FALSE(figures);
    EXPECT_EQ(figures.error().where, "disk");
}

TEST(SettingsOfAWorld, AreReadBackToTheBit) {
    ExplorationSettings settings;
    settings.tool_radius_m = 0.1 + 0.2;
    settings.scene_from_device = {{1.0 / 3.0, -2e-7, 5.0}, glm::normalize(Quat(0.3, -0.1, 0.7, 0.2)), 1.0 / 7.0};
    settings.start_scene_m = {-0.0, 1e-300, 7.0};
    settings.limits.max_force_N = 2.0 / 3.0;
    settings.shading = false;
    settings.passivity.reserve_J = 1e-5;
    const auto read = read_settings(settings_text(settings), "a.session");
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->tool_radius_m, settings.tool_radius_m);
    EXPECT_EQ(read->scene_from_device.position_m, settings.scene_from_device.position_m);
    EXPECT_EQ(read->scene_from_device.orientation, settings.scene_from_device.orientation);
    EXPECT_EQ(read->scene_from_device.scale, settings.scene_from_device.scale);
    EXPECT_EQ(read->start_scene_m, settings.start_scene_m);
    EXPECT_TRUE(std::signbit(read->start_scene_m.x));
    EXPECT_EQ(read->limits.max_force_N, settings.limits.max_force_N);
    EXPECT_FALSE(read->shading);
    EXPECT_EQ(read->passivity.reserve_J, settings.passivity.reserve_J);
    EXPECT_EQ(settings_text(*read), settings_text(settings));
    for (const char* wrong : {"", "[]", "{}", "{\"tool_radius_m\":\"0.004\"}", "nonsense", "{\"tool_radius_m\":1e999}"})
        EXPECT_FALSE(read_settings(wrong, "a.session")) << wrong;
}

}  // namespace burin::activities
