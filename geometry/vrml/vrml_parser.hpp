// SPDX-License-Identifier: MIT
// The syntax of one VRML text (ISO/IEC 14772-1:1997, annex A). Internal to geometry/vrml/. Faults are appended to the
// tree's; reading goes on behind them. Recursion: kDeepestVrmlNode levels. Threads: any. Cost: linear in the text, but
// for a logarithm of the number of names.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vrml/vrml_file.hpp"
#include "geometry/vrml/vrml_scanner.hpp"

namespace burin::geometry {

// Returns the remedy for a node or list that is not closed.
inline constexpr const char* kVrmlCutShort = "close it, or the file is cut short: copy or export it again";

class VrmlParser {
public:
    // The source's text must stay where it is; nodes and roots are added to `file`.
    VrmlParser(VrmlFile& file, std::uint32_t source);

    void parse();

private:
    // Names are looked up in the innermost PROTO body alone (DEF) or also further out (PROTO).
    struct Scope {
        std::map<std::string_view, std::uint32_t> nodes, prototypes;
        bool binds = false;  // a PROTO's body: IS means something
    };

    void fault(std::uint32_t at, std::string what, std::string remedy);
    [[nodiscard]] bool stopped() const;

    // Each reads one construct of the grammar, whose first token has not been taken yet.
    void statements(VrmlToken closing, std::uint32_t opened_at, std::vector<VrmlLink>& nodes);
    [[nodiscard]] bool statement(std::vector<VrmlLink>& nodes);
    void skip_stray(VrmlToken closing);
    [[nodiscard]] bool begins_statement() const;
    [[nodiscard]] bool begins_node() const;
    void node(std::vector<VrmlLink>& to);
    void named_node(std::vector<VrmlLink>& to);
    void use_node(std::vector<VrmlLink>& to);
    void plain_node(const VrmlLexeme& name, std::vector<VrmlLink>& to);
    void body(std::uint32_t index, std::uint32_t opened_at);
    void too_deep(std::uint32_t at);
    [[nodiscard]] bool member(std::vector<VrmlField>& fields);
    [[nodiscard]] bool too_many(const std::vector<VrmlField>& fields, std::uint32_t at);
    void declaration(bool with_value, std::vector<VrmlField>& fields);
    void interface(bool with_values, std::vector<VrmlField>& fields);
    void prototype();
    void external_prototype();
    void route();
    void skip_braces();

    void value(VrmlField& field);
    void list(VrmlField& field);
    [[nodiscard]] bool items(VrmlField& field, std::vector<VrmlLink>& nodes);
    [[nodiscard]] bool item(VrmlField& field, std::vector<VrmlLink>& nodes);
    void odd_value(VrmlField& field);
    void number(VrmlField& field);
    void binding(VrmlField& field);

    template <typename Value>
    void append(VrmlField& field, VrmlKind kind, std::vector<Value>& arena, Value value);
    void close_links(VrmlField& field, const std::vector<VrmlLink>& nodes);
    void close_fields(VrmlNode& node, const std::vector<VrmlField>& fields);

    [[nodiscard]] std::uint32_t prototype_named(std::string_view name) const;
    [[nodiscard]] VrmlField field_at(const VrmlLexeme& name) const;
    [[nodiscard]] std::string place_of(std::uint32_t at) const;

    VrmlFile& file_;
    std::uint32_t source_;
    VrmlScanner scan_;
    std::vector<Scope> scopes_{1};
    std::vector<std::uint32_t> open_;            // the nodes around the present place
    std::vector<std::string_view> prototyping_;  // the PROTOs around the present place
    bool gave_up_ = false;
    bool torn_ = false;  // the rest of the text stands in a quote that is not closed
};

}  // namespace burin::geometry
