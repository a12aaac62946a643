// SPDX-License-Identifier: MIT
#include "geometry/vrml/vrml_file.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/file_io.hpp"
#include "base/try.hpp"
#include "geometry/files/named_file.hpp"
#include "geometry/files/text_scanner.hpp"
#include "geometry/vrml/vrml_inlines.hpp"
#include "geometry/vrml/vrml_parser.hpp"
#include "geometry/vrml/vrml_scanner.hpp"
#include "geometry/vrml/vrml_text.hpp"

namespace burin::geometry {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kVrmlHeader = "#VRML V2.0 utf8";

std::vector<std::uint32_t> line_starts_of(std::string_view text) {
    std::vector<std::uint32_t> starts{0};
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool ends = text[i] == '\n' || (text[i] == '\r' && !(i + 1 < text.size() && text[i + 1] == '\n'));
        if (ends) starts.push_back(static_cast<std::uint32_t>(i + 1));
    }
    return starts;
}

struct ForeignFormat {
    std::string_view begins;
    const char* what;
    const char* remedy;
};

constexpr ForeignFormat kForeignFormats[] = {
    {"#VRML V1.0", "is VRML 1.0", "convert it to VRML 2.0 (VRML97) in a modelling program"},
    {"#X3D", "is X3D in its classic encoding", "export it as VRML 2.0 (VRML97)"},
    {"<?xml", "is XML, as X3D is", "export it as VRML 2.0 (VRML97)"},
    {"<X3D", "is X3D", "export it as VRML 2.0 (VRML97)"},
    {"#Inventor", "is an Open Inventor file", "export it as VRML 2.0 (VRML97)"},
};

// Checks that the first line says VRML 2.0, and names what it is where not.
Result<std::string_view> checked_header(std::string_view bytes, const std::string& name) {
    const std::string place = name + ":1:1";
    if (bytes.empty()) return fail(place, "is empty", "export it again");
    const Result<std::string_view> text = utf8_text(bytes, place);
    if (!text) return text;
    if (text->starts_with(kVrmlHeader) &&
        (text->size() == kVrmlHeader.size() || static_cast<unsigned char>((*text)[kVrmlHeader.size()]) <= ' ')) {
        return text;
    }
    for (const ForeignFormat& known : kForeignFormats) {
        if (text->starts_with(known.begins)) return fail(place, known.what, known.remedy);
    }
    return fail(place, "does not begin with '#VRML V2.0 utf8'",
                "write this as the first line of a VRML 2.0 file; others are named .toml, .stl, .obj, .ply or .off");
}

Result<std::string> read_vrml_bytes(const fs::path& path) {
    BURIN_TRY(bytes, read_file(path, kMostVrmlBytes));
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// Parses a file and all that it inlines, each only once.
class InlineReader {
public:
    InlineReader(VrmlFile& file, fs::path root, const VrmlOpener& opener)
        : file_(file), root_(std::move(root)), opener_(opener) {}

    // `name` is relative to the root.
    Result<std::uint32_t> read(std::string bytes, const std::string& name) {
        const std::string shown = (root_ / name).string();
        if (is_gzip(bytes)) {
            BURIN_TRY(unpacked, gunzipped(bytes, kMostVrmlBytes, shown + ":1:1"));
            bytes = std::move(unpacked);
        }
        bytes_ += bytes.size();
        if (bytes_ > kMostVrmlBytes) {
            return fail(shown + ":1:1", "the world has more than " + std::to_string(kMostVrmlBytes) + " bytes",
                        "reduce or split it");
        }
        BURIN_TRY(text, checked_header(bytes, shown));
        bytes.erase(0, static_cast<std::size_t>(text.data() - bytes.data()));  // the byte-order mark
        const auto source = static_cast<std::uint32_t>(file_.sources.size());
        if (!is_utf8(bytes)) {
            bytes = utf8_of_latin1(bytes);
            file_.remarks.push_back({{source, 0}, "is not UTF-8, as VRML 2.0 has to be", "it is read as Latin-1"});
        }
        sources_.emplace(name, source);
        VrmlSource made;
        made.name = shown;
        made.below = name;
        made.line_starts = line_starts_of(bytes);
        made.text = std::make_unique<const std::string>(std::move(bytes));
        file_.sources.push_back(std::move(made));
        VrmlFilePart part;
        part.first_node = static_cast<std::uint32_t>(file_.nodes.size());
        part.first_prototype = static_cast<std::uint32_t>(file_.prototypes.size());
        VrmlParser(file_, source).parse();
        part.end_node = static_cast<std::uint32_t>(file_.nodes.size());
        part.end_prototype = static_cast<std::uint32_t>(file_.prototypes.size());
        around_.push_back(name);
        for (std::uint32_t n = part.first_node; n < part.end_node; ++n) {
            const VrmlNode& node = file_.nodes[n];
            if (node.prototype == kNoVrmlIndex && file_.type_of(node) == "Inline") follow(n, name);
        }
        for (const std::uint32_t field : bound_inline_urls(file_, part)) follow_bound(field, source, name);
        for (std::uint32_t p = part.first_prototype; p < part.end_prototype; ++p)
            if (file_.prototypes[p].external) follow_external(p, name);
        around_.pop_back();
        return source;
    }

private:
    void follow(std::size_t node_index, const std::string& from) {
        const VrmlNode& node = file_.nodes[node_index];
        const auto fields = file_.fields_of(node);
        const auto url = std::ranges::find_if(
            fields, [&](const VrmlField& f) { return file_.text_at({node.file, f.at}, f.name_length) == "url"; });
        // Those that an instance of a PROTO names are followed apart from their Inlines (follow_bound).
        if (url == fields.end() || url->kind != VrmlKind::strings) return;
        const Opened first = first_of(*url, node.file, from);
        file_.nodes[node_index].inlined = first.source;
        if (first.fault && file_.faults.size() < kMostVrmlFaults) file_.faults.push_back(*first.fault);
    }

    // What cannot be opened is no fault yet: a PROTO's default may be one that no instance uses.
    void follow_bound(std::uint32_t field, std::uint32_t in_file, const std::string& from) {
        const Opened first = first_of(file_.fields[field], in_file, from);
        if (first.source == kNoVrmlIndex && !first.fault) return;
        file_.bound_inlines.push_back({field, first.source, first.fault.value_or(VrmlFault{})});
    }

    // Has an EXTERNPROTO be the PROTO of another file that it names. Where that is not found its instances are left
    // out. The field is copied: reading a file adds fields.
    void follow_external(std::uint32_t index, const std::string& from) {
        const VrmlPrototype external = file_.prototypes[index];
        const VrmlField url = file_.fields[external.url];
        std::optional<VrmlFault> first;
        for (std::uint32_t i = 0; url.kind == VrmlKind::strings && i < url.count; ++i) {
            const VrmlPlace place = file_.place_of_value(external.file, url, i);
            const std::string_view given = file_.strings[url.first + i];
            const std::size_t hash = given.find('#');
            const std::string name(hash != std::string_view::npos ? given.substr(hash + 1) : file_.name_of(external));
            const Result<std::uint32_t> source = opened("an EXTERNPROTO", given, from);
            if (!source) {
                const Error& error = source.error();
                const std::string what = error.where.empty() ? error.what : error.where + ": " + error.what;
                if (!first) first = VrmlFault{place, what, error.remedy};
                continue;
            }
            const auto is_meant = [&](const VrmlPrototype& p) {
                return p.file == *source && !p.external && file_.name_of(p) == name;
            };
            const auto found = std::ranges::find_if(file_.prototypes, is_meant);
            if (found != file_.prototypes.end()) {
                file_.prototypes[index] = *found;
                return;
            }
            if (!first)
                first = VrmlFault{place, file_.sources[*source].name + " has no PROTO " + in_quotes(name),
                                  "name one behind #"};
        }
        if (!first || file_.remarks.size() >= kMostVrmlFaults) return;
        file_.remarks.push_back({first->place, first->what, "what it would show is left out; " + first->remedy});
    }

    struct Opened {
        std::uint32_t source = kNoVrmlIndex;
        std::optional<VrmlFault> fault = std::nullopt;  // of the first name, where none can be opened
    };
    // Opens the first file of a list of names that can be opened. The field is copied: reading a file adds fields.
    Opened first_of(const VrmlField field, std::uint32_t in_file, const std::string& from) {
        Opened first;
        for (std::uint32_t i = 0; i < field.count; ++i) {
            const VrmlPlace place = file_.place_of_value(in_file, field, i);
            const Result<std::uint32_t> source = opened("an Inline", file_.strings[field.first + i], from);
            if (source) return {*source, std::nullopt};
            const Error& error = source.error();
            const std::string what = error.where.empty() ? error.what : error.where + ": " + error.what;
            if (!first.fault) first.fault = VrmlFault{place, what, error.remedy};
        }
        return first;
    }

    Result<std::uint32_t> opened(const std::string& who, std::string_view url, const std::string& from) {
        BURIN_TRY(name, named_vrml_file(who, url, fs::path(from).parent_path()));
        if (std::ranges::find(around_, name) != around_.end()) {
            return fail("", who + " leads back to " + in_quotes(name) + ", in which it stands",
                        "the world would have no end: remove it");
        }
        if (const auto known = sources_.find(name); known != sources_.end()) return known->second;
        if (!opener_) return fail("", "there is no folder to open " + in_quotes(name) + " from", "save it as a file");
        if (around_.size() == kDeepestVrmlNode || sources_.size() > kMostVrmlInlines) {
            return fail("", "too many files are inlined",
                        "at most " + std::to_string(kMostVrmlInlines) + " files, and " +
                            std::to_string(kDeepestVrmlNode) + " within each other, are read");
        }
        BURIN_TRY(bytes, opener_(name));
        return read(std::move(bytes), name);
    }

    VrmlFile& file_;
    fs::path root_;  // of all names
    const VrmlOpener& opener_;
    std::map<std::string, std::uint32_t> sources_;
    std::vector<std::string> around_;  // the files from the world to the present one
    std::size_t bytes_ = 0;
};

}  // namespace

const VrmlBoundInline* VrmlFile::bound_inline(const VrmlField& field) const {
    const auto index = static_cast<std::uint32_t>(&field - fields.data());
    const auto found = std::ranges::lower_bound(bound_inlines, index, {}, &VrmlBoundInline::field);
    return found != bound_inlines.end() && found->field == index ? &*found : nullptr;
}

std::string VrmlFile::where(VrmlPlace place) const {
    const VrmlSource& source = sources[place.file];
    const auto after = std::ranges::upper_bound(source.line_starts, place.at);
    const auto line = static_cast<std::size_t>(after - source.line_starts.begin());
    const std::uint32_t start = source.line_starts[line - 1];
    const std::string_view before = std::string_view(*source.text).substr(start, place.at - start);
    // Bytes that continue a character of UTF-8 are no columns of their own.
    const auto column =
        1 + std::ranges::count_if(before, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    return source.name + ":" + std::to_string(line) + ":" + std::to_string(column);
}

VrmlPlace VrmlFile::place_of_value(std::uint32_t file, const VrmlField& field, std::size_t index) const {
    VrmlScanner scan(*sources[file].text, field.value_at);
    if (scan.peek().token == VrmlToken::open_bracket) static_cast<void>(scan.take());
    for (; index > 0; --index) static_cast<void>(scan.take());
    return {file, scan.peek().at};
}

VrmlOpener vrml_files_beside(const fs::path& world) { return vrml_files_below(world.parent_path()); }

VrmlOpener vrml_files_below(const fs::path& root) {
    return [folder = root](const std::string& name) -> Result<std::string> {
        const fs::path path = folder / name;
        std::error_code code;
        const fs::path top = fs::canonical(folder.empty() ? fs::path(".") : folder, code);
        const fs::path found = file_named(top, name);
        const fs::path real = fs::weakly_canonical(found, code);
        if (std::ranges::mismatch(top, real).in1 != top.end()) {
            return fail(path.string(), "is a link that leads out of the world's folder",
                        "copy that file into the world's folder");
        }
        return read_vrml_bytes(fs::exists(path, code) ? path : found);
    };
}

Result<VrmlFile> read_vrml(std::string bytes, const std::string& name, const VrmlOpener& opener, const fs::path& root) {
    VrmlFile file;
    const fs::path path(name);
    file.opener = opener;
    file.root = root.empty() ? path.parent_path() : root;
    InlineReader reader(file, file.root, opener);
    const fs::path below = root.empty() ? path.filename() : path.lexically_relative(root);
    BURIN_TRY(source, reader.read(std::move(bytes), below.generic_string()));
    std::ranges::sort(file.bound_inlines, {}, &VrmlBoundInline::field);
    return file;
}

Result<VrmlFile> read_vrml_file(const fs::path& path, const fs::path& root) {
    BURIN_TRY(bytes, read_vrml_bytes(path));
    if (root.empty()) return read_vrml(std::move(bytes), path.string(), vrml_files_beside(path));
    const fs::path top = root.lexically_normal() / "", at = path.lexically_normal();
    std::error_code code;
    const fs::path below = fs::relative(fs::canonical(at, code), fs::canonical(top, code), code);
    if (code || below.empty() || *below.begin() == "..")
        return fail("--root " + root.string(), "is no folder in which " + path.string() + " lies",
                    "name a folder around the world's file and those that it inlines");
    return read_vrml(std::move(bytes), (top / below).string(), vrml_files_below(top), top);
}

std::string unescaped_vrml(std::string_view raw) {
    std::string text;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        if (raw[i] == '\\' && i + 1 < raw.size()) ++i;
        text += raw[i];
    }
    return text;
}

}  // namespace burin::geometry
