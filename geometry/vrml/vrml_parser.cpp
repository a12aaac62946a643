// SPDX-License-Identifier: MIT
#include "geometry/vrml/vrml_parser.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

bool is_access(const VrmlLexeme& word) {
    return word.is("eventIn") || word.is("eventOut") || word.is("field") || word.is("exposedField");
}

}  // namespace

VrmlParser::VrmlParser(VrmlFile& file, std::uint32_t source)
    : file_(file), source_(source), scan_(*file.sources[source].text) {}

void VrmlParser::parse() {
    std::vector<VrmlLink> roots;
    statements(VrmlToken::end, 0, roots);
    VrmlSource& source = file_.sources[source_];
    source.first_root = static_cast<std::uint32_t>(file_.links.size());
    source.root_count = static_cast<std::uint32_t>(roots.size());
    file_.links.insert(file_.links.end(), roots.begin(), roots.end());
}

void VrmlParser::fault(std::uint32_t at, std::string what, std::string remedy) {
    if (stopped() || torn_) return;
    file_.faults.push_back({{source_, at}, std::move(what), std::move(remedy)});
    if (file_.faults.size() < kMostVrmlFaults) return;
    file_.faults.push_back({{source_, at}, "no further faults are looked for", "repair those above first"});
    gave_up_ = true;
}

bool VrmlParser::stopped() const { return gave_up_ || file_.faults.size() > kMostVrmlFaults; }

// ---- Statements

void VrmlParser::statements(VrmlToken closing, std::uint32_t opened_at, std::vector<VrmlLink>& nodes) {
    while (!stopped()) {
        if (statement(nodes)) continue;
        const VrmlLexeme next = scan_.take();
        if (next.token == closing) return;
        if (next.token == VrmlToken::end) {
            return fault(opened_at, "the PROTO's body that begins here is not closed", kVrmlCutShort);
        }
        if (next.token == VrmlToken::word) {
            fault(next.at, in_quotes(next.text) + " is no node here, since no { follows",
                  "write the node's type and its fields in braces, or remove it");
        } else {
            fault(next.at, "a node is expected here", "remove what stands here, or look for a bracket too many before");
        }
        if (next.token == VrmlToken::open_brace) skip_braces();
        skip_stray(closing);
    }
}

// Goes on to where reading makes sense again, so that one fault is told of all that stands between.
void VrmlParser::skip_stray(VrmlToken closing) {
    for (VrmlLexeme next = scan_.peek(); next.token != VrmlToken::end && next.token != closing; next = scan_.peek()) {
        if (begins_statement()) return;
        static_cast<void>(scan_.take());
        if (next.token == VrmlToken::open_brace) skip_braces();
    }
}

bool VrmlParser::begins_statement() const {
    const VrmlLexeme next = scan_.peek();
    return next.is("PROTO") || next.is("EXTERNPROTO") || next.is("ROUTE") || begins_node();
}

// Reads a statement, if one begins here.
bool VrmlParser::statement(std::vector<VrmlLink>& nodes) {
    const VrmlLexeme next = scan_.peek();
    if (next.is("PROTO")) {
        prototype();
    } else if (next.is("EXTERNPROTO")) {
        external_prototype();
    } else if (next.is("ROUTE")) {
        route();
    } else if (begins_node()) {
        node(nodes);
    } else {
        return false;
    }
    return true;
}

bool VrmlParser::begins_node() const {
    const VrmlLexeme next = scan_.peek();
    if (next.token != VrmlToken::word || next.numeric()) return false;
    return next.is("DEF") || next.is("USE") || scan_.peek_second().token == VrmlToken::open_brace;
}

void VrmlParser::route() {
    const VrmlLexeme route = scan_.take();
    const VrmlLexeme from = scan_.take(), to = scan_.take(), target = scan_.take();
    const auto is_event = [](const VrmlLexeme& l) {
        return l.token == VrmlToken::word && l.text.find('.') != std::string_view::npos;
    };
    if (is_event(from) && to.is("TO") && is_event(target)) return;
    fault(from.at, "a ROUTE has another form", "write ROUTE Name.event TO Name.event");
    // Skips the rest of the line, which belonged to it.
    const std::string_view text = *file_.sources[source_].text;
    const std::size_t line_end = std::min(text.find_first_of("\r\n", route.at), text.size());
    scan_ = VrmlScanner(text, from.at);
    while (scan_.peek().token == VrmlToken::word && scan_.peek().at < line_end && !begins_statement())
        static_cast<void>(scan_.take());
}

// Goes behind the bracket that closes the one just taken.
void VrmlParser::skip_braces() {
    for (std::size_t depth = 1; depth > 0;) {
        const VrmlToken token = scan_.take().token;
        if (token == VrmlToken::end || token == VrmlToken::open_string) return;
        if (token == VrmlToken::open_brace || token == VrmlToken::open_bracket) ++depth;
        if (token == VrmlToken::close_brace || token == VrmlToken::close_bracket) --depth;
    }
}

// ---- Nodes

void VrmlParser::node(std::vector<VrmlLink>& to) {
    const VrmlLexeme next = scan_.peek();
    if (next.is("DEF")) return named_node(to);
    if (next.is("USE")) return use_node(to);
    plain_node({}, to);
}

void VrmlParser::named_node(std::vector<VrmlLink>& to) {
    const VrmlLexeme def = scan_.take(), name = scan_.peek();
    if (name.token != VrmlToken::word) return fault(def.at, "DEF has no name", "write DEF Name Type { ... }");
    static_cast<void>(scan_.take());
    const VrmlLexeme type = scan_.peek();
    if (begins_node() && !type.is("DEF") && !type.is("USE")) return plain_node(name, to);
    fault(name.at, "no node follows DEF " + in_quotes(name.text), "write DEF Name Type { ... }");
}

void VrmlParser::use_node(std::vector<VrmlLink>& to) {
    const VrmlLexeme use = scan_.take(), name = scan_.peek();
    if (name.token != VrmlToken::word) return fault(use.at, "USE has no name", "write USE and the name of a DEF");
    static_cast<void>(scan_.take());
    const auto& known = scopes_.back().nodes;
    const auto found = known.find(name.text);
    if (found == known.end()) {
        std::vector<std::string_view> names;
        for (const auto& [other, index] : known) {
            if (names.size() < 200) names.push_back(other);
        }
        return fault(name.at, "no node is named " + in_quotes(name.text) + " before this place",
                     names.empty() ? "name one with DEF before it is used"
                                   : "name it with DEF before it is used; the nearest name is " +
                                         in_quotes(nearest_name(name.text, names)));
    }
    // A Script may refer to itself and to the nodes around it: what its fields hold is not part of the picture.
    const auto around = std::ranges::find(open_, found->second);
    const auto is_script = [&](std::uint32_t n) { return file_.type_of(file_.nodes[n]) == "Script"; };
    if (around != open_.end() && std::none_of(around, open_.end(), is_script)) {
        return fault(name.at, in_quotes(name.text) + " is used inside itself",
                     "the node would have no end: use another node, or move USE behind it");
    }
    if (!open_.empty() && around == open_.end()) {
        file_.nodes[open_.back()].bound |= file_.nodes[found->second].bound;
    }
    to.push_back({found->second, use.at});
}

void VrmlParser::plain_node(const VrmlLexeme& name, std::vector<VrmlLink>& to) {
    const VrmlLexeme type = scan_.take(), brace = scan_.take();
    if (file_.nodes.size() == kMostVrmlNodes) {
        fault(type.at, "there are more than " + std::to_string(kMostVrmlNodes) + " nodes", "split the world");
        gave_up_ = true;
        return;
    }
    if (open_.size() == kDeepestVrmlNode) return too_deep(type.at);
    const auto index = static_cast<std::uint32_t>(file_.nodes.size());
    VrmlNode node{.file = source_, .at = type.at, .type_length = static_cast<std::uint32_t>(type.text.size())};
    if (name.token == VrmlToken::word) {
        node.name_at = name.at;
        node.name_length = static_cast<std::uint32_t>(name.text.size());
        scopes_.back().nodes.insert_or_assign(name.text, index);
    }
    if (std::ranges::find(prototyping_, type.text) != prototyping_.end()) {
        fault(type.at, "PROTO " + in_quotes(type.text) + " contains itself", "remove it from its own definition");
    } else {
        node.prototype = prototype_named(type.text);
    }
    file_.nodes.push_back(node);
    to.push_back({index, type.at});
    open_.push_back(index);
    body(index, brace.at);
    open_.pop_back();
    if (!open_.empty()) file_.nodes[open_.back()].bound |= file_.nodes[index].bound;
}

void VrmlParser::too_deep(std::uint32_t at) {
    fault(at, "nodes are nested more than " + std::to_string(kDeepestVrmlNode) + " deep",
          "take groups out of each other; this one is left out");
    skip_braces();
}

void VrmlParser::body(std::uint32_t index, std::uint32_t opened_at) {
    std::vector<VrmlField> fields;
    while (!stopped() && member(fields)) {
    }
    if (!stopped() && scan_.peek().token == VrmlToken::close_brace) {
        static_cast<void>(scan_.take());
    } else if (!stopped()) {
        fault(opened_at, in_quotes(file_.type_of(file_.nodes[index])) + " has a { here that is not closed",
              kVrmlCutShort);
    }
    close_fields(file_.nodes[index], fields);
}

// Reads a field or another part of a node's body. Nothing is left to read at the closing brace and at the end.
bool VrmlParser::member(std::vector<VrmlField>& fields) {
    const VrmlLexeme next = scan_.peek();
    if (next.token == VrmlToken::end || next.token == VrmlToken::close_brace) return false;
    if (too_many(fields, next.at)) return false;
    std::vector<VrmlLink> stray;
    if (is_access(next)) {
        static_cast<void>(scan_.take());
        declaration(next.is("field") || next.is("exposedField"), fields);
    } else if (next.token == VrmlToken::word && !next.numeric() && !begins_node()) {
        if (statement(stray)) return true;
        static_cast<void>(scan_.take());
        fields.push_back(field_at(next));
        value(fields.back());
    } else if (begins_node()) {
        node(stray);
        fault(next.at, "a node stands where a field's name is expected", "write the field's name before it");
    } else {
        static_cast<void>(scan_.take());
        if (next.token == VrmlToken::open_brace) skip_braces();
        fault(next.at, "a field's name is expected here", "remove this, or write the field's name before it");
        while (scan_.peek().numeric()) static_cast<void>(scan_.take());
    }
    return true;
}

bool VrmlParser::too_many(const std::vector<VrmlField>& fields, std::uint32_t at) {
    if (fields.size() < kMostVrmlFields) return false;
    fault(at, "there are more than " + std::to_string(kMostVrmlFields) + " fields", "remove those without effect");
    gave_up_ = true;
    return true;
}

// Reads "TYPE name [value]" or "TYPE name IS name", behind eventIn, eventOut, field or exposedField.
void VrmlParser::declaration(bool with_value, std::vector<VrmlField>& fields) {
    const VrmlLexeme type = scan_.take(), name = scan_.peek();
    if (type.token != VrmlToken::word || name.token != VrmlToken::word) {
        return fault(type.at, "a declaration has another form", "write its type and its name: field SFFloat size 1");
    }
    static_cast<void>(scan_.take());
    fields.push_back(field_at(name));
    if (with_value || scan_.peek().is("IS")) value(fields.back());
}

// ---- PROTO

void VrmlParser::interface(bool with_values, std::vector<VrmlField>& fields) {
    const VrmlLexeme bracket = scan_.peek();
    if (bracket.token != VrmlToken::open_bracket) {
        return fault(bracket.at, "the list of a PROTO's fields is expected here", "write [ ] behind its name");
    }
    static_cast<void>(scan_.take());
    while (!stopped()) {
        const VrmlLexeme next = scan_.take();
        if (next.token == VrmlToken::close_bracket) return;
        if (too_many(fields, next.at)) return;
        if (is_access(next)) {
            declaration(with_values && (next.is("field") || next.is("exposedField")), fields);
        } else if (next.token == VrmlToken::end || next.token == VrmlToken::open_brace) {
            scan_ = VrmlScanner(*file_.sources[source_].text, next.at);
            return fault(bracket.at, "the list of fields that begins here is not closed", kVrmlCutShort);
        } else {
            fault(next.at, "eventIn, eventOut, field or exposedField is expected here", "write one of them before it");
            while (scan_.peek().token == VrmlToken::word && !is_access(scan_.peek())) static_cast<void>(scan_.take());
        }
    }
}

void VrmlParser::prototype() {
    const VrmlLexeme proto = scan_.take(), name = scan_.peek();
    if (name.token != VrmlToken::word) return fault(proto.at, "PROTO has no name", "write PROTO Name [ ] { ... }");
    static_cast<void>(scan_.take());
    if (prototyping_.size() == kDeepestVrmlNode || open_.size() == kDeepestVrmlNode) {
        while (scan_.peek().token != VrmlToken::open_brace && scan_.peek().token != VrmlToken::end)
            static_cast<void>(scan_.take());
        static_cast<void>(scan_.take());
        return too_deep(name.at);
    }
    VrmlPrototype made{.file = source_, .at = name.at, .name_length = static_cast<std::uint32_t>(name.text.size())};
    prototyping_.push_back(name.text);
    // The nodes around a definition are not those around its instances.
    const std::vector<std::uint32_t> around = std::exchange(open_, {});
    std::vector<VrmlField> fields;
    std::vector<VrmlLink> nodes;
    scopes_.emplace_back();
    interface(true, fields);
    scopes_.back().binds = true;
    const VrmlLexeme brace = scan_.peek();
    if (brace.token == VrmlToken::open_brace) {
        static_cast<void>(scan_.take());
        statements(VrmlToken::close_brace, brace.at, nodes);  // without a node, instances are left out
    } else {
        fault(brace.at, "the body of PROTO " + in_quotes(name.text) + " is expected here", "write { and its nodes");
    }
    scopes_.pop_back();
    open_ = around;
    prototyping_.pop_back();
    made.first_field = static_cast<std::uint32_t>(file_.fields.size());
    made.field_count = static_cast<std::uint32_t>(fields.size());
    file_.fields.insert(file_.fields.end(), fields.begin(), fields.end());
    made.first_link = static_cast<std::uint32_t>(file_.links.size());
    made.link_count = static_cast<std::uint32_t>(nodes.size());
    file_.links.insert(file_.links.end(), nodes.begin(), nodes.end());
    scopes_.back().prototypes.insert_or_assign(name.text, static_cast<std::uint32_t>(file_.prototypes.size()));
    file_.prototypes.push_back(made);
}

void VrmlParser::external_prototype() {
    const VrmlLexeme proto = scan_.take(), name = scan_.peek();
    if (name.token != VrmlToken::word) return fault(proto.at, "EXTERNPROTO has no name", "write one behind it");
    static_cast<void>(scan_.take());
    VrmlPrototype made{.file = source_, .at = name.at, .name_length = static_cast<std::uint32_t>(name.text.size())};
    made.external = true;
    std::vector<VrmlField> fields;
    interface(false, fields);
    VrmlField url = field_at(name);
    value(url);
    made.url = static_cast<std::uint32_t>(file_.fields.size());
    file_.fields.push_back(url);
    scopes_.back().prototypes.insert_or_assign(name.text, static_cast<std::uint32_t>(file_.prototypes.size()));
    file_.prototypes.push_back(made);
}

std::uint32_t VrmlParser::prototype_named(std::string_view name) const {
    for (std::size_t i = scopes_.size(); i-- > 0;) {
        if (const auto found = scopes_[i].prototypes.find(name); found != scopes_[i].prototypes.end())
            return found->second;
    }
    return kNoVrmlIndex;
}

}  // namespace burin::geometry
