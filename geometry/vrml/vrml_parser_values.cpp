// SPDX-License-Identifier: MIT
// The parser's rule for the value of a field: it ends where the next word cannot belong to it.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/files/text_scanner.hpp"
#include "geometry/vrml/vrml_parser.hpp"

namespace burin::geometry {
namespace {

std::optional<double> vrml_number(std::string_view word) {
    if (word.starts_with("0x") || word.starts_with("0X")) {
        std::uint64_t value = 0;
        const char* const end = word.data() + word.size();
        const auto [stop, code] = std::from_chars(word.data() + 2, end, value, 16);
        if (code != std::errc{} || stop != end) return std::nullopt;
        return static_cast<double>(value);
    }
    return number_from(word);
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> lower_case) {
    return std::ranges::any_of(lower_case, [&](std::string_view known) { return equals_ignoring_case(word, known); });
}

// Tells whether the word is what programs print of a number that is none, where a number stands.
bool is_no_number(const VrmlLexeme& next) {
    return next.token == VrmlToken::word && is_one_of(next.text, {"nan", "inf", "infinity"});
}

}  // namespace

VrmlField VrmlParser::field_at(const VrmlLexeme& name) const {
    return {.at = name.at, .name_length = static_cast<std::uint32_t>(name.text.size()), .value_at = scan_.peek().at};
}

void VrmlParser::value(VrmlField& field) {
    field.value_at = scan_.peek().at;
    if (scan_.peek().token == VrmlToken::open_bracket) return list(field);
    std::vector<VrmlLink> nodes;
    if (!items(field, nodes)) odd_value(field);
    close_links(field, nodes);
}

void VrmlParser::list(VrmlField& field) {
    const VrmlLexeme bracket = scan_.take();
    std::vector<VrmlLink> nodes;
    while (!stopped()) {
        if (items(field, nodes)) continue;
        const VrmlLexeme next = scan_.peek();
        if (next.token == VrmlToken::close_bracket) {
            static_cast<void>(scan_.take());
            break;
        }
        // A closing brace belongs to a node around the list.
        if (next.token == VrmlToken::end || next.token == VrmlToken::close_brace) {
            fault(bracket.at, "a [ here is not closed", kVrmlCutShort);
            break;
        }
        static_cast<void>(scan_.take());
        const bool is_node = next.token == VrmlToken::word && scan_.peek().token == VrmlToken::open_brace;
        if (is_node) static_cast<void>(scan_.take());
        if (is_node || next.token == VrmlToken::open_brace || next.token == VrmlToken::open_bracket) skip_braces();
        fault(next.at,
              next.token == VrmlToken::word ? in_quotes(next.text) + " does not belong into this list"
                                            : std::string("this does not belong into the list"),
              "a list holds numbers, TRUE and FALSE, strings or nodes, and only one kind of them");
    }
    if (field.kind == VrmlKind::nothing) field.kind = VrmlKind::empty;
    close_links(field, nodes);
}

// Reads as many values as belong together.
bool VrmlParser::items(VrmlField& field, std::vector<VrmlLink>& nodes) {
    bool any = false;
    while (!stopped() && item(field, nodes)) any = true;
    return any;
}

bool VrmlParser::item(VrmlField& field, std::vector<VrmlLink>& nodes) {
    const VrmlLexeme next = scan_.peek();
    const auto fits = [&](VrmlKind kind) { return field.kind == VrmlKind::nothing || field.kind == kind; };
    if (next.numeric() || is_no_number(next)) {
        if (!fits(VrmlKind::numbers)) return false;
        number(field);
    } else if (next.is("TRUE") || next.is("FALSE")) {
        if (!fits(VrmlKind::booleans)) return false;
        static_cast<void>(scan_.take());
        append(field, VrmlKind::booleans, file_.numbers, next.is("TRUE") ? 1.0 : 0.0);
    } else if (next.token == VrmlToken::string || next.token == VrmlToken::open_string) {
        if (!fits(VrmlKind::strings)) return false;
        static_cast<void>(scan_.take());
        append(field, VrmlKind::strings, file_.strings, next.text);
        if (next.token == VrmlToken::open_string) {
            fault(next.at, "a quote here is not closed", kVrmlCutShort);
            torn_ = true;
        }
    } else if (next.is("IS")) {
        if (field.kind != VrmlKind::nothing) return false;
        binding(field);
    } else if (next.is("NULL")) {
        if (!fits(VrmlKind::nodes)) return false;
        static_cast<void>(scan_.take());
        field.kind = VrmlKind::nodes;
    } else if (begins_statement()) {  // a ROUTE among nodes has no place in the grammar, and files have it
        if (!fits(VrmlKind::nodes)) return false;
        field.kind = VrmlKind::nodes;
        if (!statement(nodes)) return false;
    } else {
        return false;
    }
    return true;
}

void VrmlParser::number(VrmlField& field) {
    const VrmlLexeme word = scan_.take();
    const auto value = vrml_number(word.text);
    if (!value) fault(word.at, in_quotes(word.text) + " is not a number", "repair the file or export it again");
    // Whoever reads the field says what is not finite; nobody reads normals.
    append(field, VrmlKind::numbers, file_.numbers, value.value_or(0.0));
}

void VrmlParser::binding(VrmlField& field) {
    const VrmlLexeme is = scan_.take(), name = scan_.peek();
    if (name.token != VrmlToken::word) return fault(is.at, "IS has no name", "write the name of a field of the PROTO");
    static_cast<void>(scan_.take());
    if (!scopes_.back().binds)
        return fault(is.at, "IS stands outside of a PROTO's body", "write the value in its place");
    if (!open_.empty()) file_.nodes[open_.back()].bound = true;
    append(field, VrmlKind::is, file_.strings, name.text);
}

// Explains why no value follows a field's name.
void VrmlParser::odd_value(VrmlField& field) {
    field.kind = VrmlKind::broken;
    const VrmlLexeme next = scan_.peek();
    const std::string name = in_quotes(file_.text_at({source_, field.at}, field.name_length));
    if (next.token == VrmlToken::word && is_one_of(next.text, {"true", "false"})) {
        static_cast<void>(scan_.take());
        return fault(next.at, in_quotes(next.text) + " is not a value", "write TRUE or FALSE in capitals");
    }
    if (next.token == VrmlToken::word && scan_.peek_second().token != VrmlToken::word &&
        scan_.peek_second().token != VrmlToken::string && scan_.peek_second().token != VrmlToken::open_bracket) {
        static_cast<void>(scan_.take());
        return fault(next.at, in_quotes(next.text) + " is not a value of field " + name,
                     "write a number, TRUE, FALSE, a string in quotes, or a node with its braces");
    }
    fault(field.at, name + " has no value", "write one behind it, or remove the field");
    if (next.token == VrmlToken::open_brace) {
        static_cast<void>(scan_.take());
        skip_braces();
    }
}

template <typename Value>
void VrmlParser::append(VrmlField& field, VrmlKind kind, std::vector<Value>& arena, Value value) {
    if (field.count == 0) field.first = static_cast<std::uint32_t>(arena.size());
    field.kind = kind;
    ++field.count;
    arena.push_back(value);
}

void VrmlParser::close_links(VrmlField& field, const std::vector<VrmlLink>& nodes) {
    if (field.kind != VrmlKind::nodes) return;
    field.first = static_cast<std::uint32_t>(file_.links.size());
    field.count = static_cast<std::uint32_t>(nodes.size());
    file_.links.insert(file_.links.end(), nodes.begin(), nodes.end());
}

void VrmlParser::close_fields(VrmlNode& node, const std::vector<VrmlField>& fields) {
    node.first_field = static_cast<std::uint32_t>(file_.fields.size());
    node.field_count = static_cast<std::uint32_t>(fields.size());
    file_.fields.insert(file_.fields.end(), fields.begin(), fields.end());
}

}  // namespace burin::geometry
