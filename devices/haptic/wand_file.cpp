// SPDX-License-Identifier: MIT
#include "devices/haptic/wand_file.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/toml_table.hpp"
#include "base/try.hpp"

namespace burin::devices {
namespace {

constexpr std::uint64_t kMostFileBytes = 1 << 20;

// Bounds of what a device can be: beyond them a number is in another unit.
constexpr double kMostLength_m = 10.0, kMostForce_N = 1000.0, kMostTorque_Nm = 100.0;

// Reads a number that has to lie within bounds, both included; `otherwise` where it is left out.
double bounded(TableReader& t, const char* key, double least, double most, double otherwise) {
    const double value = t.number(key).value_or(otherwise);
    if (value >= least && value <= most) return value;
    t.refuse(key, formatted("is %g", value), formatted("write a number from %g to %g", least, most));
    return otherwise;
}

Vec3 bounded(TableReader& t, const char* key, const Vec3& least, const Vec3& most, const Vec3& otherwise) {
    const Vec3 value = t.vector(key).value_or(otherwise);
    for (int axis = 0; axis < 3; ++axis) {
        if (value[axis] >= least[axis] && value[axis] <= most[axis]) continue;
        t.refuse(key, formatted("has %g for %c", value[axis], "xyz"[axis]),
                 formatted("write a number from %g to %g there", least[axis], most[axis]));
        return otherwise;
    }
    return value;
}

// A number above 0.
double positive(TableReader& t, const char* key, double most, double otherwise) {
    return bounded(t, key, 1e-9, most, otherwise);
}

Pose read_pose(TableReader& t, const Pose& otherwise) {
    Pose pose;
    pose.position_m = bounded(t, "position", Vec3(-kMostLength_m), Vec3(kMostLength_m), otherwise.position_m);
    pose.orientation = t.quaternion("orientation").value_or(otherwise.orientation);
    return pose;
}

std::optional<int> axis_named(std::string_view name) {
    if (name == "x" || name == "y" || name == "z") return name[0] - 'x';
    return std::nullopt;
}

// Returns why --points could not name a point so; empty where it can.
std::string not_a_point_name(std::string_view name) {
    const auto is_blank = [](char c) { return c == ' ' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    if (std::ranges::all_of(name, is_blank)) return "nothing stands there";
    if (is_blank(name.front()) || is_blank(name.back())) return "blanks stand around it";
    if (std::ranges::any_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
        return "it holds control characters";
    if (std::ranges::all_of(name, is_digit)) return "a number says how many points touch";
    if (name == "centre") return "that is the handle's origin";
    return name.contains(',') ? "a comma separates names" : "";
}

// Reads one file; collects problems on the way.
class WandReader {
public:
    WandReader(const std::string& name, const WandDescription& otherwise) : reading_{name}, wand_(otherwise) {}

    WandOrProblems read(const toml::table& root) {
        TableReader t(reading_, &root, "the file");
        wand_.name = t.text("name").value_or(wand_.name);
        wand_.rate_Hz = bounded(t, "rate", 100.0, 10'000.0, wand_.rate_Hz);
        read_workspace(t.table("workspace"));
        read_frame(t.table("frame"));
        read_limits(t.table("force"), t.table("torque"));
        read_handle(t.table("handle"));
        const std::vector<const toml::table*> points = t.tables("point");
        if (t.has("point")) read_points(points);
        read_calibration(t.table("calibration"));
        read_arm(t.table("arm"));
        read_mechanism(t.table("mechanism"));
        t.refuse_unknown();
        if (!reading_.errors.empty()) return std::unexpected(std::move(reading_.errors));
        return std::move(wand_);
    }

private:
    void read_workspace(const toml::table* table) {
        TableReader t(reading_, table, "[workspace]");
        Box& box = wand_.workspace_maker_m;
        const Vec3 far(kMostLength_m);
        box.lo = bounded(t, "lowest", -far, far, box.lo);
        box.hi = bounded(t, "highest", -far, far, box.hi);
        for (int axis = 0; axis < 3; ++axis) {
            if (box.lo[axis] < box.hi[axis]) continue;
            const char* const key = t.has("highest") ? "highest" : "lowest";
            t.refuse(key, formatted("leaves no room along %c: %g to %g", "xyz"[axis], box.lo[axis], box.hi[axis]),
                     "let highest be above lowest");
            break;
        }
        // Beyond a right angle a handle has no pitch and roll that tell its pose.
        const Vec3 upright(89.0);
        const Vec3 lowest = bounded(t, "lowest_turn", -upright, Vec3(0.0), wand_.lowest_turn_rad / kDegree_rad);
        const Vec3 highest = bounded(t, "highest_turn", Vec3(0.0), upright, wand_.highest_turn_rad / kDegree_rad);
        if (t.has("lowest_turn")) wand_.lowest_turn_rad = lowest * kDegree_rad;
        if (t.has("highest_turn")) wand_.highest_turn_rad = highest * kDegree_rad;
        t.refuse_unknown();
    }

    void read_frame(const toml::table* table) {
        TableReader t(reading_, table, "[frame]");
        read_axes(t);
        wand_.scene_from_maker = read_pose(t, wand_.scene_from_maker);
        wand_.gain = bounded(t, "gain", 1e-3, 1e3, wand_.gain);
        t.refuse_unknown();
    }

    void read_axes(TableReader& t) {
        constexpr const char* kRemedy =
            "write [\"+x\", \"+y\", \"+z\"], say: the maker's axes that the device's x, y and z are";
        const std::optional<std::vector<std::string>> words = t.texts("axes");
        if (!words) return;
        AxisMap axes;
        std::array<bool, 3> used{};
        bool good = words->size() == 3;
        for (std::size_t i = 0; good && i < 3; ++i) {
            std::string_view word = (*words)[i];
            axes.sign[i] = word.starts_with('-') ? -1.0 : 1.0;
            if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
            const std::optional<int> axis = axis_named(word);
            good = axis && !used[static_cast<std::size_t>(*axis)];
            if (!good) break;
            axes.maker[i] = *axis;
            used[static_cast<std::size_t>(*axis)] = true;
        }
        if (!good) return t.refuse("axes", "does not name each of x, y and z once", kRemedy);
        const auto column = [&](const Vec3& maker) { return device_axes(axes, maker); };
        const double handedness = glm::dot(glm::cross(column({1, 0, 0}), column({0, 1, 0})), column({0, 0, 1}));
        if (handedness < 0.0)
            return t.refuse("axes", "is a mirror image, which no device can be turned into",
                            "change the sign of one of them");
        wand_.axes = axes;
    }

    void read_limits(const toml::table* force, const toml::table* torque) {
        TableReader f(reading_, force, "[force]");
        wand_.max_force_maker_N = bounded(f, "limit", Vec3(1e-3), Vec3(kMostForce_N), wand_.max_force_maker_N);
        f.refuse_unknown();
        TableReader t(reading_, torque, "[torque]");
        const std::optional<std::vector<std::string>> driven = t.texts("driven");
        // Asked for also where it is not there, so that it is among the keys that a mistyped one may have meant.
        std::optional<std::vector<double>> limits;
        if (driven || !t.has("limit")) limits = t.numbers("limit", driven ? driven->size() : 0);
        if (t.has("driven") || t.has("limit")) {
            constexpr const char* kRemedy = "write driven = [\"x\", \"z\"] and limit = [0.23, 0.25], say";
            t.require("driven", kRemedy);
            t.require("limit", kRemedy);
            if (driven && t.has("limit")) read_torques(t, *driven, limits);
            if (!t.has("driven")) return;
        }
        t.refuse_unknown();
    }

    void read_torques(TableReader& t, const std::vector<std::string>& words,
                      const std::optional<std::vector<double>>& limits) {
        Vec3 most(0.0);
        for (std::size_t i = 0; i < words.size(); ++i) {
            const std::optional<int> axis = axis_named(words[i]);
            if (!axis || most[*axis] != 0.0)
                return t.refuse("driven", "has " + words[i] + (axis ? " twice" : ""),
                                "write x, y and z at most once each");
            const double limit = limits ? (*limits)[i] : 1.0;
            if (!(limit > 0.0 && limit <= kMostTorque_Nm))
                return t.refuse("limit", formatted("is %g for %s", limit, words[i].c_str()),
                                formatted("write a number above 0, at most %g", kMostTorque_Nm));
            most[*axis] = limit;
        }
        wand_.max_torque_maker_Nm = most;
    }

    void read_handle(const toml::table* table) {
        TableReader t(reading_, table, "[handle]");
        wand_.handle_m = positive(t, "length", kMostLength_m, wand_.handle_m);
        wand_.device_tool_from_handle = read_pose(t, wand_.device_tool_from_handle);
        t.refuse_unknown();
    }

    void read_points(const std::vector<const toml::table*>& tables) {
        wand_.points.clear();
        std::set<std::string> names;
        for (const toml::table* table : tables) {
            TableReader t(reading_, table, "[[point]]");
            t.require("name", "give each point a name, such as \"top\"");
            t.require("offset", "say where it is on the handle: [0, 0.08, 0]");
            WandPoint point;
            const std::optional<std::string> name = t.text("name");
            point.name = name.value_or("");
            point.offset_m = bounded(t, "offset", Vec3(-kMostLength_m), Vec3(kMostLength_m), Vec3(0.0));
            if (name)
                if (const std::string why = not_a_point_name(point.name); !why.empty())
                    t.refuse("name", "is \"" + point.name + "\": " + why, "name it by a word, such as \"top\"");
            if (name && !names.insert(point.name).second)
                t.refuse("name", "\"" + point.name + "\" is another point's too", "give each a name of its own");
            t.refuse_unknown();
            wand_.points.push_back(std::move(point));
        }
        if (wand_.points.size() > kMostWandPoints)
            reading_.refuse(*tables[kMostWandPoints], formatted("is one point more than %zu", kMostWandPoints),
                            "leave some out");
    }

    void read_calibration(const toml::table* table) {
        TableReader t(reading_, table, "[calibration]");
        WandCalibration& c = wand_.calibration;
        c.maker_from_handle = read_pose(t, c.maker_from_handle);
        c.tolerance_m = positive(t, "tolerance", 0.1, c.tolerance_m);
        const double degrees = positive(t, "turn_tolerance", 45.0, c.tolerance_rad / kDegree_rad);
        if (t.has("turn_tolerance")) c.tolerance_rad = degrees * kDegree_rad;
        t.refuse_unknown();
    }

    void read_arm(const toml::table* table) {
        TableReader t(reading_, table, "[arm]");
        WandArm& arm = wand_.arm;
        arm.mass_kg = bounded(t, "mass", 1e-3, 100.0, arm.mass_kg);
        arm.damping_Ns_per_m = bounded(t, "damping", 0.0, 1e3, arm.damping_Ns_per_m);
        arm.friction_N = bounded(t, "friction", 0.0, 100.0, arm.friction_N);
        arm.inertia_kgm2 = bounded(t, "inertia", 1e-6, 10.0, arm.inertia_kgm2);
        arm.angular_damping_Nms_per_rad = bounded(t, "angular_damping", 0.0, 10.0, arm.angular_damping_Nms_per_rad);
        arm.angular_friction_Nm = bounded(t, "angular_friction", 0.0, 10.0, arm.angular_friction_Nm);
        arm.resolution_m = bounded(t, "resolution", 0.0, 0.01, arm.resolution_m);
        const double step = bounded(t, "turn_resolution", 0.0, 10.0, arm.orientation_step_rad / kDegree_rad);
        if (t.has("turn_resolution")) arm.orientation_step_rad = step * kDegree_rad;
        // More would not be known to the energy account while it is on its way (haptics/stability/energy_account.hpp).
        arm.delay_s = bounded(t, "delay", 0.0, 3.0 / wand_.rate_Hz, arm.delay_s);
        arm.max_stiffness_N_per_m = positive(t, "stiffness", 1e6, arm.max_stiffness_N_per_m);
        arm.max_torsion_Nm_per_rad = positive(t, "torsion", 1e4, arm.max_torsion_Nm_per_rad);
        t.refuse_unknown();
    }

    // Six numbers, one a joint, each within bounds.
    void read_joints(TableReader& t, const char* key, double least, double most, double unit, WandJoints& to) {
        const std::optional<std::vector<double>> values = t.numbers(key, kWandJoints);
        if (!values) return;
        for (std::size_t i = 0; i < kWandJoints; ++i) {
            if (!((*values)[i] >= least && (*values)[i] <= most))
                return t.refuse(key, formatted("has %g for joint %zu", (*values)[i], i),
                                formatted("write a number from %g to %g there", least, most));
            to[i] = unit * (*values)[i];
        }
    }

    void read_signs(TableReader& t, const char* key, WandJoints& to) {
        WandJoints signs = to;
        read_joints(t, key, -1.0, 1.0, 1.0, signs);
        for (const double sign : signs)
            if (std::abs(sign) != 1.0) return t.refuse(key, formatted("has %g", sign), "write 1 or -1 for each joint");
        to = signs;
    }

    void read_mechanism(const toml::table* table) {
        TableReader t(reading_, table, "[mechanism]");
        WandMechanism& m = wand_.mechanism;
        constexpr double kMostLink_m = 2.0;
        m.card = t.text("card").value_or(m.card);
        if (m.card.empty())
            t.refuse("card", "is empty", "write the card's type as the maker's library calls it, such as \"q8\"");
        m.arm.shoulders_m = bounded(t, "shoulders", 0.0, kMostLink_m, m.arm.shoulders_m);
        m.arm.upper_m = bounded(t, "upper", 1e-3, kMostLink_m, m.arm.upper_m);
        m.arm.fore_m = bounded(t, "fore", 1e-3, kMostLink_m, m.arm.fore_m);
        m.arm.waists_m = bounded(t, "waists", 1e-3, kMostLink_m, m.arm.waists_m);
        m.arm.offset_m = bounded(t, "offset", 0.0, kMostLink_m, m.arm.offset_m);
        m.handle_tolerance_m = positive(t, "handle_tolerance", 0.1, m.handle_tolerance_m);
        m.counts_a_turn = bounded(t, "counts", 100.0, 1e8, m.counts_a_turn);
        read_signs(t, "encoder_signs", m.encoder_sign);
        read_joints(t, "jig", -360.0, 360.0, kDegree_rad, m.jig_rad);
        read_joints(t, "torque_constants", 1e-4, 100.0, 1.0, m.torque_Nm_per_A);
        read_joints(t, "currents", 1e-3, 100.0, 1.0, m.most_A);
        read_signs(t, "motor_signs", m.motor_sign);
        m.volts_per_A = bounded(t, "volts_per_ampere", 1e-3, 100.0, m.volts_per_A);
        WandJoints lines;
        std::ranges::copy(m.enable_lines, lines.begin());
        read_joints(t, "enable_lines", 0.0, 63.0, 1.0, lines);
        std::ranges::transform(lines, m.enable_lines.begin(),
                               [](double line) { return static_cast<std::uint32_t>(line); });
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (lines[i] != std::floor(lines[i]))
                t.refuse("enable_lines", formatted("has %g", lines[i]), "write the whole number of a digital output");
            if (std::find(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(i), lines[i]) !=
                lines.begin() + static_cast<std::ptrdiff_t>(i))
                t.refuse("enable_lines", formatted("has %g twice", lines[i]),
                         "write six different ones: each amplifier is switched by its own");
        }
        if (t.has("jig") && !wand_tips(m.arm, m.jig_rad))
            t.refuse("jig", "is a pose that its linkages do not reach",
                     "see the order of the joints in docs/devices.md");
        t.refuse_unknown();
    }

    TableReading reading_;
    WandDescription wand_;
};

}  // namespace

WandOrProblems parse_wand(std::string_view text, const std::string& name, const WandDescription& otherwise) {
    const Result<toml::table> root = parse_toml(text, name);
    if (!root) return std::unexpected(std::vector{root.error()});
    return WandReader(name, otherwise).read(*root);
}

Result<WandDescription> read_wand(const std::filesystem::path& path, const WandDescription& otherwise) {
    BURIN_TRY(text, read_text_file(path, kMostFileBytes));
    WandOrProblems wand = parse_wand(text, path.string(), otherwise);
    if (wand) return std::move(*wand);
    const std::vector<Error>& problems = wand.error();
    if (problems.size() == 1) return std::unexpected(problems.front());
    std::string lines = std::to_string(problems.size()) + " problems:";
    for (const Error& problem : problems) lines += "\n  " + problem.line();
    return fail(path.string(), lines);
}

}  // namespace burin::devices
