// SPDX-License-Identifier: MIT
// Reads the fields of a VRML node as values of a type, through IS where the node stands in a PROTO, and collects what
// is wrong with them. Internal to geometry/vrml/. Pure but for the lists of faults and remarks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/space.hpp"
#include "geometry/vrml/vrml_file.hpp"

namespace burin::geometry {

// An instance of a PROTO, which gives the names after IS their values.
struct VrmlInstance {
    std::uint32_t node = 0;
    const VrmlInstance* outer = nullptr;  // around the instance; null: none
    bool named = false;                   // it, or one around it, has a DEF
    std::size_t depth = 1;                // of instances within each other
};

// A node where it stands.
struct VrmlPlaced {
    std::uint32_t node = 0;
    const VrmlInstance* within = nullptr;
};

// A field's value where it stands.
struct VrmlValue {
    const VrmlField* field = nullptr;
    std::uint32_t file = 0;
    const VrmlInstance* within = nullptr;  // of the nodes in it
};

// Which numbers of a list are sound. Others are a fault.
struct VrmlNumberLimits {
    double most = 1e9;         // in size; kMaxCoordinate
    bool not_numbers = false;  // nan is sound: the caller judges
};
inline constexpr VrmlNumberLimits kAnyVrmlNumber{std::numeric_limits<double>::infinity(), true};

// Numbers of a field, and the place of each.
struct VrmlNumbers {
    std::span<const double> values;
    VrmlValue value;  // no field: the default
};

class VrmlFields {
public:
    explicit VrmlFields(const VrmlFile& file) : file_(file) {}

    [[nodiscard]] const VrmlFile& file() const { return file_; }
    [[nodiscard]] const VrmlNode& node(const VrmlPlaced& placed) const { return file_.nodes[placed.node]; }
    [[nodiscard]] std::string_view type(const VrmlPlaced& placed) const { return file_.type_of(node(placed)); }
    [[nodiscard]] VrmlPlace place(const VrmlPlaced& placed) const { return {node(placed).file, node(placed).at}; }

    void fault(VrmlPlace place, std::string what, std::string remedy);
    void remark(VrmlPlace place, std::string what, std::string remedy);
    // Points at one of a field's values.
    void fault_at_value(const VrmlValue& value, std::size_t index, std::string what, std::string remedy);
    void remark_at_value(const VrmlValue& value, std::size_t index, std::string what, std::string remedy);
    [[nodiscard]] bool full() const { return faults_.size() >= kMostVrmlFaults; }

    [[nodiscard]] bool remarked_enough() const { return remarks_.size() >= kMostVrmlFaults; }

    // Counts work: a node each time that it is gone through, and long lists of fields, nodes and numbers beyond that,
    // so that what USE and PROTO repeat cannot take for ever. Returns false, and that is a fault, beyond
    // kMostVrmlNodes.
    bool spend(VrmlPlace place, std::size_t nodes);
    [[nodiscard]] bool spent_all() const { return spent_ > kMostVrmlNodes; }
    [[nodiscard]] const std::set<VrmlFault>& faults() const { return faults_; }
    [[nodiscard]] const std::set<VrmlFault>& remarks() const { return remarks_; }

    // Returns the value of the field, or of what it is bound to; nothing where it keeps its default.
    [[nodiscard]] std::optional<VrmlValue> find(const VrmlPlaced& placed, std::string_view name);

    // Return the default where the field is missing, or where it is wrong, which is a fault.
    [[nodiscard]] double number(const VrmlPlaced& placed, std::string_view name, double otherwise);
    // Where it is not above zero, which is remarked on, returns 0: there is nothing to show.
    [[nodiscard]] double positive(const VrmlPlaced& placed, std::string_view name, double otherwise);
    // Where it is not from 0 to 1, which is remarked on, returns the nearer of these.
    [[nodiscard]] double from_0_to_1(const VrmlPlaced& placed, std::string_view name, double otherwise);
    [[nodiscard]] std::int64_t integer(const VrmlPlaced& placed, std::string_view name, std::int64_t otherwise);
    [[nodiscard]] bool flag(const VrmlPlaced& placed, std::string_view name, bool otherwise);
    [[nodiscard]] Vec3 vector(const VrmlPlaced& placed, std::string_view name, const Vec3& otherwise);
    // Returns red, green and blue; each that is not from 0 to 1 as from_0_to_1() does. Where one is no number, which is
    // remarked on, returns `otherwise`.
    [[nodiscard]] Vec3 colour(const VrmlPlaced& placed, std::string_view name, const Vec3& otherwise);
    [[nodiscard]] Quat rotation(const VrmlPlaced& placed, std::string_view name);

    // Returns all numbers of a field, which come in groups of `size`. No field: it is missing. Empty where it is wrong.
    [[nodiscard]] VrmlNumbers numbers(const VrmlPlaced& placed, std::string_view name, std::size_t size = 1,
                                      const VrmlNumberLimits& limits = {});
    // Returns the nodes of a field.
    [[nodiscard]] std::vector<VrmlPlaced> nodes(const VrmlPlaced& placed, std::string_view name);

    // Returns the node that an instance of a PROTO stands for, through any number of them; the node itself where it is
    // no instance; nothing for an EXTERNPROTO.
    [[nodiscard]] std::optional<VrmlPlaced> resolved(VrmlPlaced placed);
    // Goes one step of that way; `placed` is an instance.
    [[nodiscard]] std::optional<VrmlPlaced> body_of(const VrmlPlaced& placed);

    // Remarks on fields that the node's type does not have. Does nothing for types that are not read.
    void check_names(const VrmlPlaced& placed);

private:
    [[nodiscard]] const VrmlField* field_of(std::span<const VrmlField> fields, std::uint32_t file,
                                            std::string_view name) const;
    // Returns the field's numbers where there are exactly `count`.
    [[nodiscard]] std::span<const double> exactly(const VrmlPlaced& placed, std::string_view name, std::size_t count);
    [[nodiscard]] bool are_sound(const VrmlValue& value, std::span<const double> numbers, std::string_view name,
                                 const VrmlNumberLimits& limits);
    [[nodiscard]] bool is_kind(const VrmlValue& value, VrmlKind kind, std::string_view name, const char* expected);

    const VrmlFile& file_;
    std::deque<VrmlInstance> instances_;  // a deque, so that they stay where they are
    std::set<VrmlFault> faults_, remarks_;
    std::set<std::pair<const VrmlField*, std::size_t>> blamed_;  // values whose place has been looked for
    std::size_t spent_ = 0;
};

// Returns the rotation about an axis of any length; none about an axis without length, as files write for no rotation.
[[nodiscard]] inline Quat vrml_rotation(const Vec3& axis, double angle_rad) {
    const double length = glm::length(axis);
    return length > 0.0 ? glm::angleAxis(angle_rad, axis / length) : Quat(1.0, 0.0, 0.0, 0.0);
}

// Returns whether ISO/IEC 14772-1 has a node of this type; and the nearest type that it has.
[[nodiscard]] bool is_vrml_type(std::string_view type);
[[nodiscard]] std::string_view nearest_vrml_type(std::string_view type);

}  // namespace burin::geometry
