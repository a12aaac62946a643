// SPDX-License-Identifier: MIT
// Reads ASCII OFF: OFF with ST, C and N before it in any order, the counts of vertices, faces and edges (the last may
// be missing), then a line for each vertex, x y z [normal] [colour] [texture], and for each face, n i1 .. in [colour].
// Comments start with #. Lines count: a number too many or too few is a fault of its own line and moves no other one. A
// file of fewer lines than that may have several vertices in a line.
// Colours are 3 or 4 numbers: with a decimal point they run from 0 to 1, else as ColourScale says; a single number is
// an index into a map that the file does not hold. A comment near the beginning may state the unit.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/text_scanner.hpp"
#include "geometry/files/unit_statement.hpp"

namespace burin::geometry {
namespace {

constexpr char kOffComment = '#';
constexpr const char* kOneALine = "write one vertex or face a line";
constexpr std::size_t kMostColourNumbers = 4;

// A colour as the file has it, of which vertex or face, and in which line.
struct FileColour {
    Vec3 numbers{0.0};
    bool has_point = false;
    std::uint64_t line = 0;
    std::size_t of = 0;
};

class OffReader {
public:
    OffReader(std::string_view text, const std::string& name) : text_(text), scan_(text), name_(name) {}

    Result<MeshSoup> read() {
        soup_.report.format = "OFF";
        soup_.stated_unit = unit_in_comments(text_);
        if (auto done = header(); !done) return std::unexpected(done.error());
        while (soup_.positions.size() < vertices_) {
            if (auto done = vertices(); !done) return std::unexpected(done.error());
        }
        while (soup_.corner_counts.size() < faces_) {
            if (auto done = face(); !done) return std::unexpected(done.error());
        }
        if (has_texture_)
            soup_.report.remarks.emplace_back("its texture coordinates were ignored: an OFF names no picture");
        if (next_line()) soup_.report.remarks.push_back("text after the last face was ignored");
        if (uncoloured_ > 0) {
            soup_.report.remarks.push_back("the colour map indices of " + std::to_string(uncoloured_) +
                                           " faces were ignored");
        }
        resolve_colours();
        return std::move(soup_);
    }

private:
    using Done = Result<void>;

    std::unexpected<Error> wrong(const std::string& what, const char* remedy = kTruncatedRemedy) const {
        return fail(at_line(name_, line_), what, remedy);
    }

    // Reads the words of the next line that has any; false at the end of the text.
    bool next_line() {
        words_.clear();
        for (; !scan_.at_end() && words_.empty(); scan_.next_line()) {
            line_ = scan_.line();
            for (auto word = scan_.token_in_line(kOffComment); !word.empty(); word = scan_.token_in_line(kOffComment))
                words_.push_back(word);
        }
        return !words_.empty();
    }

    // ---- Header

    Done header() {
        if (!next_line()) return wrong("does not begin with OFF", "check that it is an OFF file");
        std::string_view keyword = words_.front();
        take_kind(keyword);
        if (keyword.size() < 3 || !equals_ignoring_case(keyword.substr(0, 3), "off")) {
            return wrong("does not begin with OFF, or with a kind of OFF other than [ST][C][N]OFF",
                         "convert it to PLY");
        }
        keyword.remove_prefix(3);  // the counts may stand right behind it
        words_.erase(words_.begin());
        if (!keyword.empty()) words_.insert(words_.begin(), keyword);
        if (words_.empty() && !next_line()) return wrong("ends before its counts");
        if (equals_ignoring_case(words_.front(), "binary")) return wrong("is a binary OFF file", "convert it to PLY");
        return counts();
    }

    // Takes the letters before OFF off the keyword; programs disagree on their order.
    void take_kind(std::string_view& keyword) {
        while (take_prefix(keyword, "st", has_texture_) || take_prefix(keyword, "c", has_colours_) ||
               take_prefix(keyword, "n", has_normals_)) {
        }
    }
    static bool take_prefix(std::string_view& word, std::string_view prefix, bool& has) {
        if (has || !equals_ignoring_case(word.substr(0, prefix.size()), prefix)) return false;
        word.remove_prefix(prefix.size());
        return has = true;
    }

    Done counts() {
        std::array<std::uint64_t, 3> counts{};  // of vertices, faces and edges; the last may be missing
        for (std::size_t i = 0; i < std::min(words_.size(), counts.size()); ++i) {
            const auto value = integer_from<std::uint64_t>(words_[i]);
            if (!value) return wrong(in_quotes(words_[i]) + " stands where a count should");
            counts[i] = *value;
        }
        if (words_.size() < 2 || words_.size() > 3) {
            return wrong("has " + std::to_string(words_.size()) + " counts in a line",
                         "write the numbers of vertices, faces and edges into one line");
        }
        vertices_ = counts[0];
        faces_ = counts[1];
        // A vertex takes at least three digits and three blanks, a face a digit and a blank; allows a little less for
        // the file's end.
        const std::uint64_t room = (text_.size() - scan_.position()) / 2 + 1;
        if (vertices_ > room / 3 + 1 || faces_ > room || vertices_ * 3 + faces_ > room + 3) {
            return wrong("claims " + std::to_string(vertices_) + " vertices and " + std::to_string(faces_) +
                         " faces, more than the file can hold");
        }
        // Fewer lines than vertices and faces: some lines hold several vertices.
        TextScanner rest = scan_;
        std::uint64_t lines = 0;
        for (; !rest.at_end() && lines < vertices_ + faces_; rest.next_line())
            lines += rest.token_in_line(kOffComment).empty() ? 0 : 1;
        may_share_lines_ = lines < vertices_ + faces_;
        return {};
    }

    // ---- Vertices

    // Reads the vertex of a line, or several.
    Done vertices() {
        if (!next_line()) return wrong("ends in the middle of its vertices");
        const std::size_t before = has_normals_ ? 6 : 3, behind = has_texture_ ? 2 : 0;
        if (may_share_lines_ && before == 3 && behind == 0 && !has_colours_ && words_.size() % 3 == 0) {
            for (std::size_t at = 0; at < words_.size() && soup_.positions.size() < vertices_; at += 3) {
                if (auto done = position(at); !done) return done;
            }
            return {};
        }
        if (words_.size() < before + behind) return wrong("a vertex has " + numbers(words_.size()) + ", too few");
        const std::size_t colour_numbers = words_.size() - before - behind;
        if (colour_numbers > (has_colours_ ? kMostColourNumbers : 0)) {
            return wrong("a vertex has " + numbers(words_.size()) + ", too many",
                         has_colours_ ? kOneALine : "write one vertex a line, and COFF or NOFF for colours or normals");
        }
        if (auto done = position(0); !done) return done;
        for (std::size_t i = 3; i < words_.size(); ++i) {
            if (const auto value = number(i); !value) return std::unexpected(value.error());
        }
        if (!has_colours_) return {};
        return colour(before, colour_numbers, soup_.positions.size() - 1, vertex_colours_);
    }

    Done position(std::size_t at) {
        Vec3 p;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto value = number(at + k);
            if (!value) return std::unexpected(value.error());
            p[static_cast<int>(k)] = *value;
            if (coordinate_fault(*value) == nullptr) soup_.precision.see(words_[at + k], *value);
        }
        add_vertex(soup_, p, line_);
        return {};
    }

    Result<double> number(std::size_t at) const {
        const auto value = number_from(words_[at]);
        if (!value) return wrong(in_quotes(words_[at]) + " is not a number");
        return *value;
    }
    static std::string numbers(std::size_t count) {
        return std::to_string(count) + (count == 1 ? " number" : " numbers");
    }

    // ---- Faces

    Done face() {
        if (!next_line()) return wrong("ends in the middle of its faces");
        const auto count = integer_from<std::uint32_t>(words_.front());
        if (!count) return wrong(in_quotes(words_.front()) + " stands where a face's number of corners should");
        if (words_.size() <= *count)
            return wrong("a face of " + std::to_string(*count) + " corners names " + std::to_string(words_.size() - 1));
        for (std::uint32_t i = 1; i <= *count; ++i) {
            const auto index = integer_from<std::uint32_t>(words_[i]);
            if (!index) return wrong(in_quotes(words_[i]) + " is not a vertex index");
            if (*index >= vertices_) {
                return wrong("a face names vertex " + std::to_string(*index) + ", but there are only " +
                                 std::to_string(vertices_) + " (counted from 0)",
                             "repair the file");
            }
            soup_.corners.push_back(*index);
        }
        soup_.corner_counts.push_back(*count);
        return colour(*count + 1, words_.size() - *count - 1, soup_.corner_counts.size() - 1, face_colours_);
    }

    // ---- Colours

    // Takes note of a colour of `count` numbers from the word `at` on; only the whole file tells its scale.
    Done colour(std::size_t at, std::size_t count, std::size_t of, std::vector<FileColour>& colours) {
        if (count == 0) return {};
        if (count > kMostColourNumbers) return wrong("a line has too many numbers", kOneALine);
        if (count == 2) return wrong("a colour has 2 numbers", "give 3 or 4");
        FileColour colour{Vec3(0.0), false, line_, of};
        for (std::size_t k = 0; k < count; ++k) {
            const auto value = number_from(words_[at + k]);
            const bool is_alpha = k == 3;
            if (!value) return wrong(in_quotes(words_[at + k]) + " stands where a colour should", "repair the file");
            if (is_alpha || count == 1) break;
            colour.numbers[static_cast<int>(k)] = *value;
            colour.has_point = colour.has_point || words_[at + k].find_first_of(".eE") != std::string_view::npos;
        }
        if (count == 1) return ++uncoloured_, Done{};
        (colour.has_point ? with_point_ : whole_).see(colour.numbers);
        colours.push_back(colour);
        return {};
    }

    Colour bytes_of(const FileColour& colour) {
        return (colour.has_point ? with_point_ : whole_).bytes_of(colour.numbers, colour.line);
    }

    // Gives vertices and faces their colours; those without one among others get the plain one.
    void resolve_colours() {
        with_point_.see(Vec3(0.5));  // these run to 1, even if all are whole
        if (has_colours_) soup_.colours.assign(soup_.positions.size(), kPlainColour);
        for (const FileColour& colour : vertex_colours_) soup_.colours[colour.of] = bytes_of(colour);
        if (!face_colours_.empty()) {
            std::vector<Colour> colours(soup_.corner_counts.size(), kPlainColour);
            for (const FileColour& colour : face_colours_) colours[colour.of] = bytes_of(colour);
            for (const Colour& colour : colours) soup_.face_materials.push_back(materials_.index_of(colour));
        }
        for (const ColourScale* scale : {&with_point_, &whole_}) {
            std::ranges::move(scale->remarks("colours"), std::back_inserter(soup_.report.remarks));
        }
    }

    std::string_view text_;
    TextScanner scan_;
    const std::string& name_;
    std::vector<std::string_view> words_;  // of the line read last
    std::uint64_t line_ = 1;
    MeshSoup soup_;
    ColourMaterials materials_{soup_.materials};
    std::vector<FileColour> vertex_colours_, face_colours_;
    ColourScale with_point_, whole_;
    bool has_texture_ = false, has_colours_ = false, has_normals_ = false, may_share_lines_ = false;
    std::uint64_t vertices_ = 0, faces_ = 0, uncoloured_ = 0;
};

}  // namespace

Result<MeshSoup> read_off(std::string_view text, const std::string& name) { return OffReader(text, name).read(); }

}  // namespace burin::geometry
