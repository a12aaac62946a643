// SPDX-License-Identifier: MIT
#include "devices/trackers/tracker_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/file_io.hpp"
#include "base/length_unit.hpp"
#include "base/text.hpp"
#include "base/toml_table.hpp"
#include "base/try.hpp"

namespace burin::devices {
namespace {

constexpr std::uint64_t kMostTrackerFileBytes = 1 << 20;
constexpr double kMostMount_m = 10.0;  // beyond it an offset is in another unit
constexpr double kMostAhead_ms = static_cast<double>(kMostAhead_ns) / 1e6;
constexpr const char* kUnits = "write m, mm, cm, in or ft";

// Reads one description; collects problems on the way.
class TrackerReader {
public:
    TrackerReader(TableReading& reading, const toml::table& table, const std::string& place)
        : reading_(reading), t_(reading, &table, place) {}

    // With `file` the rest is in another file: its name is left in `other_file`.
    TrackerDescription read(std::string* other_file) {
        tracker_.file = reading_.file;
        if (other_file != nullptr) {
            *other_file = t_.text("file").value_or("");
            if (t_.has("file")) return read_reference();
        }
        tracker_.name = t_.text("name").value_or("");
        t_.require("address", "say where it is heard, such as address = \"vrpn:10.0.0.2\" or \"dtrack:5000\"");
        read_address();
        read_units();
        read_axes();
        tracker_.bodies.frame.world_from_tracker = read_place();
        if (t_.has("prediction_ms")) usual_ahead_ns_ = ahead(t_);
        read_head();
        read_wands();
        if (!t_.has("head") && !t_.has("wand"))
            reading_.add({"names neither a head nor a wand", reading_.file,
                          "add [head] with body = \"Tracker0/0\", say, or a [[wand]]"});
        tracker_.bodies.are_named = true;
        t_.refuse_unknown();
        return std::move(tracker_);
    }

private:
    TrackerDescription read_reference() {
        read_address();
        t_.refuse_unknown();
        return std::move(tracker_);
    }

    void read_address() {
        const auto address = t_.text("address");
        if (!address) return;
        kind_ = tracker_kind_of(*address);
        if (kind_ == nullptr)
            t_.refuse("address", "is " + *address + ", which is no tracker that Burin knows",
                      "write udp:, vrpn: or dtrack: and what follows: " + tracker_usage());
        else if (address->contains(','))
            t_.refuse("address", "has settings after a comma",
                      "give them keys of their own: [head] body = ..., axes = ...");
        else
            tracker_.address = *address;
    }

    double unit_named(const char* key, double otherwise_m) {
        const auto word = t_.text(key);
        if (!word) return otherwise_m;
        const auto unit = length_unit(*word);
        if (!unit) t_.refuse(key, "is " + *word, kUnits);
        return unit ? metres_in(*unit) : otherwise_m;
    }

    void read_units() {
        t_.require("units", "write units = \"m\" (or mm, cm, in, ft): of every length in this file");
        unit_m_ = unit_named("units", 0.0);  // lengths of an unknown unit are no news
        if (t_.has("reported_units") && kind_ != nullptr && kind_->has_unit)
            t_.refuse("reported_units",
                      "is set, but the protocol of " + std::string(kind_->scheme) + " has a unit itself",
                      "leave it out; `units` is of the lengths in this file");
        tracker_.bodies.frame.unit_m = unit_named("reported_units", 1.0);
    }

    // The rows of M from a list such as ["+x", "+z", "-y"]: each word is an axis of the system.
    std::optional<glm::dmat3> permutation() {
        const auto words = t_.texts("axes");
        if (!words) return std::nullopt;
        glm::dmat3 system_from_tracker(0.0);
        bool is_good = words->size() == 3;
        for (int i = 0; is_good && i < 3; ++i) {
            const std::string& word = (*words)[static_cast<std::size_t>(i)];
            const std::string_view letter = std::string_view(word).substr(word.find_first_not_of("+-") == 1 ? 1 : 0);
            is_good = letter.size() == 1 && letter[0] >= 'x' && letter[0] <= 'z';
            if (is_good) system_from_tracker[i][letter[0] - 'x'] = word.starts_with('-') ? -1.0 : 1.0;
        }
        if (!is_good || std::abs(glm::determinant(system_from_tracker)) < 0.5) {
            t_.refuse("axes", "does not name each of x, y and z once",
                      "write [\"+x\", \"+z\", \"-y\"], say: the tracker's axes that are the world's x, y and z");
            return std::nullopt;
        }
        return glm::transpose(system_from_tracker);
    }

    std::optional<glm::dmat3> matrix() {
        const auto rows = t_.rows("rotation", 3);
        if (!rows) return std::nullopt;
        glm::dmat3 read(0.0);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                read[column][row] = (*rows)[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        return read;
    }

    void read_axes() {
        const auto hand = t_.text("handedness");
        const bool is_left = hand && *hand == "left";
        if (hand && !is_left && *hand != "right")
            t_.refuse("handedness", "is " + *hand, "write right or left: of the system that the tracker reports in");
        const bool by_words = t_.has("axes");
        const auto words = permutation();
        const auto rows = matrix();
        const char* const key = by_words ? "axes" : t_.has("rotation") ? "rotation" : "handedness";
        if (by_words && t_.has("rotation")) {
            t_.refuse("rotation", "stands beside axes, which says the same", "leave one of them out");
            return;
        }
        if ((by_words && !words) || (t_.has("rotation") && !rows)) return;  // told already
        const auto frame = frame_with_axes(words ? *words : rows.value_or(glm::dmat3(1.0)), is_left);
        if (frame) {
            tracker_.bodies.frame.tracker_from_system = frame->tracker_from_system;
            tracker_.bodies.frame.is_left_handed = frame->is_left_handed;
        } else if (is_left && key == std::string_view("handedness")) {
            t_.refuse(key, "is left, and nothing says how the axes lie",
                      "add axes = [\"+x\", \"+y\", \"-z\"], say: the tracker's axes that are the world's x, y and z");
        } else {
            t_.refuse(key, frame.error(),
                      key == std::string_view("rotation")
                          ? "write three rows, each of length 1 and at right angles to the others; of a left-handed "
                            "system with handedness = \"left\""
                      : is_left ? "change the sign of one of them, or leave handedness out"
                                : "change the sign of one of them; of a left-handed system write handedness = "
                                  "\"left\" as well");
        }
    }

    Pose pose_of(TableReader& t) {
        Pose pose;
        if (const auto position = t.vector("position")) {
            pose.position_m = unit_m_ * *position;
            if (glm::length(pose.position_m) > kMostTracked_m)
                t.refuse("position", formatted("is %g m away", glm::length(pose.position_m)),
                         "see that units is right");
        }
        pose.orientation = t.quaternion("orientation").value_or(pose.orientation);
        return pose;
    }

    std::optional<Pose> read_place() {
        const toml::table* const table = t_.table("world_from_tracker");
        if (table == nullptr) return std::nullopt;
        TableReader t(reading_, table, "[world_from_tracker]");
        const Pose pose = pose_of(t);
        t.refuse_unknown();
        return pose;
    }

    Nanoseconds ahead(TableReader& t) {
        const double ms = t.number("prediction_ms").value_or(0.0);
        if (ms >= 0.0 && ms <= kMostAhead_ms) return static_cast<Nanoseconds>(std::llround(ms * 1e6));
        t.refuse("prediction_ms", formatted("is %g", ms),
                 formatted("write milliseconds from 0 to %g: how late its poses come", kMostAhead_ms));
        return 0;
    }

    TrackedMount mount_of(TableReader& t) {
        TrackedMount mount{pose_of(t), usual_ahead_ns_};
        if (glm::length(mount.body_from_point.position_m) > kMostMount_m)
            t.refuse("position", formatted("is %g m from the body", glm::length(mount.body_from_point.position_m)),
                     "see that units is right");
        if (t.has("prediction_ms")) mount.ahead_ns = ahead(t);
        return mount;
    }

    std::optional<TrackedSource> source(TableReader& t, const char* key) {
        const auto text = t.text(key);
        if (!text) return std::nullopt;
        auto named = tracked_source(*text);
        if (!named || text->contains(',')) {
            t.refuse(key, "is \"" + *text + "\", which names nothing", "write NAME/NUMBER, such as \"Tracker0/0\"");
            return std::nullopt;
        }
        if (kind_ != nullptr && !kind_->names.empty() &&
            std::ranges::find(kind_->names, named->name) == kind_->names.end()) {
            t.refuse(key, "is \"" + *text + "\", which " + std::string(kind_->scheme) + " has not",
                     "write a number behind one of: " + joined(kind_->names));
            return std::nullopt;
        }
        return named;
    }

    void read_head() {
        const toml::table* const table = t_.table("head");
        if (table == nullptr) return;
        TableReader t(reading_, table, "[head]");
        t.require("body", "say which body the head's is: body = \"Tracker0/0\"");
        tracker_.bodies.head = source(t, "body");
        tracker_.bodies.head_mount = mount_of(t);
        t.refuse_unknown();
    }

    void read_wands() {
        const auto tables = t_.tables("wand");
        for (std::size_t i = 0; i < tables.size(); ++i) {
            if (i == kTrackedWands) {
                reading_.refuse(*tables[i], formatted("is one wand more than %zu", kTrackedWands), "leave some out");
                return;
            }
            read_wand(*tables[i], i);
        }
    }

    void read_wand(const toml::table& table, std::size_t wand) {
        TableReader t(reading_, &table, "[[wand]]");
        TrackerBodies& to = tracker_.bodies;
        t.require("body", "say which body this wand's is: body = \"Tracker0/1\"");
        to.wands[wand] = source(t, "body");
        if (to.wands[wand] && (to.wands[wand] == to.head || (wand > 0 && to.wands[wand] == to.wands[0])))
            t.refuse("body", "is the body of another one too", "give each a body of its own");
        to.wand_mounts[wand] = mount_of(t);
        to.buttons[wand] = source(t, "buttons");
        to.sticks[wand] = source(t, "stick");
        read_order(t, to.button_orders[wand]);
        t.refuse_unknown();
    }

    void read_order(TableReader& t, std::vector<std::int32_t>& order) {
        const toml::node* const node = t.find("button_order");
        const toml::array* const list = node == nullptr ? nullptr : node->as_array();
        const std::size_t count = list == nullptr ? 1 : list->size();
        const auto numbers = t.numbers("button_order", count);
        if (!numbers) return;
        for (const double number : *numbers) {
            const bool is_whole = number == std::floor(number) && number >= 0.0 && number < 256.0;
            const auto button = is_whole ? static_cast<std::int32_t>(number) : -1;
            if (!is_whole || std::ranges::find(order, button) != order.end() || count > kMostTrackedButtons)
                return t.refuse("button_order", formatted("has %g", number),
                                "write each of the device's buttons at most once, counted from 0, 32 at most: "
                                "button_order = [0, 2, 1]");
            order.push_back(button);
        }
    }

    TableReading& reading_;
    TableReader t_;
    TrackerDescription tracker_;
    const TrackerKind* kind_ = nullptr;
    double unit_m_ = 1.0;
    Nanoseconds usual_ahead_ns_ = 0;
};

std::string exact(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", value);
    return text.data();
}

// Leaves out what only rounding has put there.
Vec3 without_rounding(Vec3 v) {
    for (int i = 0; i < 3; ++i)
        if (std::abs(v[i] - std::round(v[i])) < 1e-12) v[i] = std::round(v[i]) + 0.0;
    return v;
}

std::string list_of(const Vec3& v) { return "[" + exact(v.x) + ", " + exact(v.y) + ", " + exact(v.z) + "]"; }

std::string quoted(const std::string& text) {
    std::ostringstream out;
    out << toml::value<std::string>(text);
    return out.str();
}

std::string quoted(const TrackedSource& source) { return quoted(source.name + "/" + std::to_string(source.number)); }

std::string pose_text(const Pose& pose) {
    const Quat& q = pose.orientation;
    return "position = " + list_of(pose.position_m) + "\norientation = [" + exact(q.x) + ", " + exact(q.y) + ", " +
           exact(q.z) + ", " + exact(q.w) + "]\n";
}

std::string mount_text(const TrackedMount& mount) {
    return pose_text(mount.body_from_point) + "prediction_ms = " + exact(static_cast<double>(mount.ahead_ns) / 1e6) +
           "\n";
}

std::string frame_text(const TrackerFrame& frame) {
    const glm::dmat3 rotation = glm::mat3_cast(frame.tracker_from_system) * (frame.is_left_handed ? -1.0 : 1.0);
    std::string rows;
    for (int row = 0; row < 3; ++row)
        rows +=
            (row == 0 ? "" : ", ") + list_of(without_rounding({rotation[0][row], rotation[1][row], rotation[2][row]}));
    return "rotation = [" + rows + "]\nhandedness = " + (frame.is_left_handed ? "\"left\"" : "\"right\"") + "\n";
}

}  // namespace

Result<TrackerDescription> parse_tracker(std::string_view text, const std::string& name) {
    BURIN_TRY(root, parse_toml(text, name));
    TableReading reading{name};
    TrackerDescription tracker = TrackerReader(reading, root, "the file").read(nullptr);
    BURIN_TRY_DO(reading.outcome());
    return tracker;
}

Result<TrackerDescription> read_tracker(const std::filesystem::path& path) {
    BURIN_TRY(text, read_text_file(path, kMostTrackerFileBytes));
    return parse_tracker(text, path.string());
}

Result<std::optional<TrackerDescription>> tracker_of_wall(const std::filesystem::path& wall) {
    BURIN_TRY(text, read_text_file(wall, kMostTrackerFileBytes));
    BURIN_TRY(root, parse_toml(text, wall.string()));
    TableReading reading{wall.string()};
    TableReader file(reading, &root, "the file");
    const toml::table* const table = file.table("tracker");
    if (table == nullptr) return std::optional<TrackerDescription>{};
    std::string other;
    TrackerDescription tracker = TrackerReader(reading, *table, "[tracker]").read(&other);
    BURIN_TRY_DO(reading.outcome());
    if (other.empty()) return tracker;
    BURIN_TRY(described, read_tracker(wall.parent_path() / other));
    if (tracker.address.empty()) return std::move(described);
    if (tracker_kind_of(tracker.address) != tracker_kind_of(described.address))
        return fail(wall.string(),
                    "has the address " + tracker.address + " for a tracker of another kind, " + described.address +
                        " in " + described.file,
                    "give both the same kind");
    described.address = tracker.address;
    return std::move(described);
}

std::string tracker_text(const TrackerDescription& tracker, const std::string& under) {
    const TrackerBodies& bodies = tracker.bodies;
    const std::string prefix = under.empty() ? "" : under + ".";
    std::string text = under.empty() ? "" : "[" + under + "]\n";
    text += "name = " + quoted(tracker.name) + "\naddress = " + quoted(tracker.address) + "\nunits = \"m\"\n";
    const TrackerKind* const kind = tracker_kind_of(tracker.address);
    const double unit_m = bodies.frame.unit_m;
    if (kind != nullptr && !kind->has_unit)
        for (const LengthUnitDescriptor& unit : length_units())
            if (metres_in(unit.unit) == unit_m) text += "reported_units = \"" + std::string(unit.name) + "\"\n";
    text += frame_text(bodies.frame);
    if (bodies.frame.world_from_tracker)
        text += "\n[" + prefix + "world_from_tracker]\n" + pose_text(*bodies.frame.world_from_tracker);
    if (bodies.head)
        text += "\n[" + prefix + "head]\nbody = " + quoted(*bodies.head) + "\n" + mount_text(bodies.head_mount);
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) {
        if (!bodies.wands[wand]) continue;
        text += "\n[[" + prefix + "wand]]\nbody = " + quoted(*bodies.wands[wand]) + "\n" +
                mount_text(bodies.wand_mounts[wand]);
        if (bodies.buttons[wand]) text += "buttons = " + quoted(*bodies.buttons[wand]) + "\n";
        if (bodies.sticks[wand]) text += "stick = " + quoted(*bodies.sticks[wand]) + "\n";
        if (bodies.button_orders[wand].empty()) continue;
        std::string order;
        for (const std::int32_t button : bodies.button_orders[wand])
            order += (order.empty() ? "" : ", ") + std::to_string(button);
        text += "button_order = [" + order + "]\n";
    }
    return text;
}

}  // namespace burin::devices
