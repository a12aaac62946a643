// SPDX-License-Identifier: MIT
// Columns: each has one name, and under it stand the values of the tick.
#include "record/columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <string>
#include <utility>

#include "tests/record/made_ticks.hpp"

namespace burin::record {
namespace {

class NamedRow {
public:
    NamedRow(const haptics::TickRecord& record, const RowShape& shape)
        : columns_(columns_for(shape)), words_(row_of(record, shape)) {}

    [[nodiscard]] Word word(const std::string& name) const {
        for (std::size_t c = 0; c < columns_.size(); ++c)
            if (columns_[c].name == name) return words_[c];
        ADD_FAILURE() << "no column " << name;
        return 0;
    }
    [[nodiscard]] double number(const std::string& name) const { return std::bit_cast<double>(word(name)); }

private:
    std::vector<Column> columns_;
    std::vector<Word> words_;
};

}  // namespace

TEST(Columns, HaveNamesOfTheirOwnAndAValueEach) {
    for (const RowShape shape : {RowShape{0, 1}, RowShape{6, 2}, RowShape{8, haptics::kMostProbePoints}}) {
        const std::vector<Column> columns = columns_for(shape);
        EXPECT_EQ(row_of(test::made_tick(7, shape.points), shape).size(), columns.size());
        EXPECT_LE(columns.size(), 1024u);
        std::set<std::string> names;
        for (const Column& column : columns) EXPECT_TRUE(names.insert(column.name).second) << column.name;
    }
}

// A name ends in its unit and says its frame: who reads a table has nothing else.
TEST(Columns, HaveTheUnitAndTheFrameThatTheirNamesSay) {
    constexpr std::array kEndings{
        std::pair("_rad_per_s", "rad/s"), std::pair("_m_per_s", "m/s"), std::pair("_Nm", "Nm"), std::pair("_N", "N"),
        std::pair("_rad", "rad"),         std::pair("_m", "m"),         std::pair("_ns", "ns")};
    const auto unit_of = [&](const std::string& name) -> std::string {
        if (name.starts_with("joint")) return "rad or m";
        const auto found = std::ranges::find_if(kEndings, [&](const auto& e) { return name.ends_with(e.first); });
        return found != kEndings.end() ? found->second : "";
    };
    const auto frame_of = [](const std::string& name) -> std::string {
        if (name.contains("_object_") || name.starts_with("object_from_device_") || name.starts_with("penetration"))
            return name == "object_from_device_scale" ? "" : "object";
        return name.contains("_device_") ? "device" : "";
    };
    for (const RowShape shape : {RowShape{0, 1}, RowShape{6, 2}, RowShape{8, haptics::kMostProbePoints}}) {
        for (const Column& column : columns_for(shape)) {
            EXPECT_EQ(column.unit, unit_of(column.name)) << column.name;
            EXPECT_EQ(column.frame, frame_of(column.name)) << column.name;
        }
    }
}

TEST(Columns, HoldTheValuesOfTheTick) {
    const haptics::TickRecord record = test::made_tick(41, 2);
    const NamedRow row(record, {3, 2});
    EXPECT_EQ(row.word("tick"), 41u);
    EXPECT_EQ(row.word("time_ns"), static_cast<Word>(record.time_ns));
    EXPECT_EQ(row.word("buttons"), 1u);
    EXPECT_EQ(row.number("position_device_y_m"), record.sample.position_device_m.y);
    EXPECT_EQ(row.number("orientation_device_qw"), record.sample.orientation_device.w);
    EXPECT_EQ(row.number("joint2"), record.sample.joints[2]);
    EXPECT_EQ(row.number("hip1_object_z_m"), record.contact.points[1].hip_object_m.z);
    EXPECT_EQ(row.number("proxy1_object_x_m"), record.contact.points[1].proxy_object_m.x);
    EXPECT_EQ(row.number("force0_device_z_N"), record.contact.points[0].force_device_N.z);
    EXPECT_EQ(row.word("triangle1"), 42u);
    EXPECT_EQ(row.number("desired_force_device_y_N"), record.wanted.force_device_N.y);
    EXPECT_EQ(row.number("commanded_force_device_y_N"), record.gate.given.force_device_N.y);
    EXPECT_EQ(row.word("surface_sequence"), 4u);
    EXPECT_EQ(row.word("saturated_axes"), 2u) << "y alone was made smaller";
}

TEST(Columns, APointThatATickDoesNotHaveIsNoNumber) {
    const NamedRow row(test::made_tick(3, 1), {0, 3});
    EXPECT_EQ(row.word("points"), 1u);
    EXPECT_FALSE(std::isnan(row.number("hip0_object_x_m")));
    EXPECT_TRUE(std::isnan(row.number("hip1_object_x_m")));
    EXPECT_TRUE(std::isnan(row.number("force2_device_z_N")));
    EXPECT_EQ(row.word("triangle2"), haptics::kNoTriangle);
}

TEST(Columns, TheRotationVectorTurnsAsTheQuaternionDoes) {
    for (const Quat& q : {Quat(1, 0, 0, 0), glm::angleAxis(0.5, Vec3(0, 0, 1)), glm::angleAxis(3.0, Vec3(1, 0, 0)),
                          -glm::angleAxis(1.0, glm::normalize(Vec3(1, 2, 3)))}) {
        haptics::TickRecord record;
        record.sample.orientation_device = q;
        const NamedRow row(record, {});
        const Vec3 turn(row.number("rotation_device_x_rad"), row.number("rotation_device_y_rad"),
                        row.number("rotation_device_z_rad"));
        const double angle = glm::length(turn);
        EXPECT_LE(angle, 3.1415926536);
        // Rodrigues' formula, which knows no quaternion.
        const Vec3 v(0.3, -0.7, 0.2), axis = angle > 0.0 ? turn / angle : Vec3(1, 0, 0);
        const Vec3 turned = v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
                            axis * glm::dot(axis, v) * (1.0 - std::cos(angle));
        EXPECT_LT(glm::length(turned - q * v), 1e-14);
    }
}

TEST(Columns, AreChosenByNameAndByBeginning) {
    const std::vector<Column> columns = columns_for(RowShape{0, 1});
    EXPECT_EQ(choose_columns(columns, "")->size(), columns.size());
    EXPECT_EQ(*choose_columns(columns, "time_ns,tick"), (std::vector<std::size_t>{1, 0}));
    EXPECT_EQ(choose_columns(columns, "tick,tick,tic*")->size(), 1u);
    EXPECT_EQ(choose_columns(columns, "hip0*")->size(), 3u);
    const auto wrong = choose_columns(columns, "tick,hip0_object_x");
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().line().find("hip0_object_x_m"), std::string::npos) << wrong.error().line();
    // A short word is nearer to a short name than to the long one that it stands for: "tick" was suggested.
    for (const auto& [word, meant] :
         {std::pair("force_x", "force0_device_x_N"), std::pair("proxy_y", "proxy0_object_y_m")}) {
        const auto shortened = choose_columns(columns, word);
        ASSERT_FALSE(shortened);
        EXPECT_NE(shortened.error().line().find(meant), std::string::npos) << shortened.error().line();
    }
    EXPECT_FALSE(choose_columns(columns, "tick,"));
    EXPECT_FALSE(choose_columns(columns, "nothing*"));
}

}  // namespace burin::record
