// SPDX-License-Identifier: MIT
#include "geometry/vrml/vrml_inlines.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <utility>

#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

// A field of a PROTO, by the PROTO's index and the field's name.
using BoundField = std::pair<std::uint32_t, std::string_view>;

class UrlFlow {
public:
    UrlFlow(const VrmlFile& file, const VrmlFilePart& part) : file_(file), part_(part) {}

    std::vector<std::uint32_t> sources() {
        for (std::uint32_t p = part_.first_prototype; p < part_.end_prototype; ++p) walk_body(p);
        while (!open_.empty()) {
            const BoundField field = open_.back();
            open_.pop_back();
            for (const BoundField& outer : outer_of_[field]) reach(outer);
        }
        if (!reached_.empty()) collect();
        return std::move(found_);
    }

private:
    [[nodiscard]] std::string_view name_in(std::uint32_t file, const VrmlField& field) const {
        return file_.text_at({file, field.at}, field.name_length);
    }

    void reach(const BoundField& field) {
        if (reached_.insert(field).second) open_.push_back(field);
    }

    // Goes through the nodes of a PROTO's body and notes what is bound to its fields.
    void walk_body(std::uint32_t prototype) {
        const VrmlPrototype& p = file_.prototypes[prototype];
        std::vector<std::uint32_t> open;
        std::set<std::uint32_t> seen;
        const auto enter = [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t i = first; i < first + count; ++i)
                if (seen.insert(file_.links[i].node).second) open.push_back(file_.links[i].node);
        };
        enter(p.first_link, p.link_count);
        while (!open.empty()) {
            const VrmlNode& node = file_.nodes[open.back()];
            open.pop_back();
            const bool is_inline = node.prototype == kNoVrmlIndex && file_.type_of(node) == "Inline";
            for (const VrmlField& field : file_.fields_of(node)) {
                if (field.kind == VrmlKind::nodes) enter(field.first, field.count);
                if (field.kind != VrmlKind::is) continue;
                const BoundField bound{prototype, file_.strings[field.first]};
                if (is_inline && name_in(node.file, field) == "url") reach(bound);
                if (node.prototype != kNoVrmlIndex)
                    outer_of_[{node.prototype, name_in(node.file, field)}].push_back(bound);
            }
        }
    }

    // Notes the texts of all fields that reach an Inline: of instances, and the PROTOs' defaults.
    void collect() {
        const auto note = [&](std::uint32_t first_field, std::uint32_t count, std::uint32_t file,
                              std::uint32_t prototype) {
            for (std::uint32_t i = first_field; i < first_field + count; ++i) {
                const VrmlField& field = file_.fields[i];
                if (field.kind == VrmlKind::strings && reached_.contains({prototype, name_in(file, field)}))
                    found_.push_back(i);
            }
        };
        for (std::uint32_t p = part_.first_prototype; p < part_.end_prototype; ++p) {
            const VrmlPrototype& prototype = file_.prototypes[p];
            note(prototype.first_field, prototype.field_count, prototype.file, p);
        }
        for (std::uint32_t n = part_.first_node; n < part_.end_node; ++n) {
            const VrmlNode& node = file_.nodes[n];
            if (node.prototype != kNoVrmlIndex) note(node.first_field, node.field_count, node.file, node.prototype);
        }
    }

    const VrmlFile& file_;
    VrmlFilePart part_;
    std::map<BoundField, std::vector<BoundField>> outer_of_;  // what takes its value from a field of the PROTO around
    std::set<BoundField> reached_;
    std::vector<BoundField> open_;
    std::vector<std::uint32_t> found_;
};

}  // namespace

std::vector<std::uint32_t> bound_inline_urls(const VrmlFile& file, const VrmlFilePart& part) {
    return UrlFlow(file, part).sources();
}

Result<std::string> named_vrml_file(const std::string& who, std::string_view raw, const std::filesystem::path& folder) {
    constexpr const char* kRemedy = "copy that file into the world's folder and name it without a path";
    const std::string url = percent_decoded(unescaped_vrml(raw.substr(0, raw.find('#'))));
    if (url.empty()) return fail("", who + " names no file", "write its name in quotes behind url");
    if (raw.find('\\') != std::string_view::npos)
        return fail("", who + " names " + in_quotes(raw) + ", with a backslash", "write / between folder and file");
    const std::size_t colon = url.find(':');
    if (colon != std::string::npos && colon < url.find('/'))
        return fail("", who + " names " + in_quotes(url) + ", which is no file of this folder", kRemedy);
    const std::filesystem::path path = (folder / url).lexically_normal();
    const bool leaves = url.front() == '/' || path.is_absolute() || path.empty() || *path.begin() == "..";
    if (leaves || path.filename().empty() || url.find('\0') != std::string::npos)
        return fail("", who + " leads to " + in_quotes(url) + ", outside of the world's folder",
                    std::string(kRemedy) + ", or allow a folder around both with --root");
    return path.generic_string();
}

std::string percent_decoded(std::string_view url) {
    std::string text;
    for (std::size_t i = 0; i < url.size(); ++i) {
        unsigned byte = 0;
        const char* const digits = url.data() + i + 1;
        const bool is_coded =
            url[i] == '%' && i + 2 < url.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
        text += is_coded ? static_cast<char>(byte) : url[i];
        if (is_coded) i += 2;
    }
    return text;
}

}  // namespace burin::geometry
