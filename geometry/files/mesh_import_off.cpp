// SPDX-License-Identifier: MIT
// Reads ASCII OFF as Geomview defines it: OFF (which may be missing) with ST, C and N before it in any order, the
// counts of vertices, faces and edges (the last may be missing), then the vertices, x y z [normal] [colour] [texture],
// and the faces, n i1 .. in [colour]. Comments start with #. All numbers may stand in lines as they like, but a face's
// colour ends with its line.
// Most files have a vertex or a face in each line, and there a number too many or too few is a fault of its own line
// that moves no other one. So a file is read that way first. Where rows do not keep to lines, nothing may be left over
// behind the last face, and these are faults: lines as many as rows, and a face that goes over lines with a colour that
// others do not have.
// Colours are 3 or 4 numbers: with a decimal point they run from 0 to 1, else as ColourScale says; a single number is
// an index into a map that the file does not hold. A comment near the beginning may state the unit.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/try.hpp"
#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/text_scanner.hpp"
#include "geometry/files/unit_statement.hpp"

namespace burin::geometry {
namespace {

constexpr char kOffComment = '#';
constexpr const char* kOneALine = "write one vertex or face a line";
constexpr std::size_t kMostColourNumbers = 4, kCounts = 3;

// A colour as the file has it, of which vertex or face, and in which line.
struct FileColour {
    Vec3 numbers{0.0};
    bool has_point = false;
    std::uint64_t line = 0;
    std::size_t of = 0;
};

// How the numbers of vertices stand: each vertex in a line of its own, or anyhow, with so many numbers of colour each
// and behind two or three counts.
struct OffLayout {
    bool keeps_to_lines = true;
    std::size_t colour_numbers = 0;
    bool counts_edges = false;
};

class OffReader {
public:
    OffReader(std::string_view text, const std::string& name, const OffLayout& layout)
        : text_(text), scan_(text), name_(name), layout_(layout) {}

    Result<MeshSoup> read() {
        soup_.report.format = "OFF";
        soup_.stated_unit = unit_in_comments(text_);
        BURIN_TRY_DO(header());
        BURIN_TRY_DO(layout_.keeps_to_lines ? vertices_in_lines() : vertices_anyhow());
        while (soup_.corner_counts.size() < faces_) {
            BURIN_TRY_DO(face());
        }
        if (has_texture_)
            soup_.report.remarks.emplace_back("its texture coordinates were ignored: an OFF names no picture");
        BURIN_TRY_DO(end());
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

    // Returns the next word, in this line or a later one; empty at the end of the text.
    std::string_view next_word() {
        const std::string_view word = scan_.token(kOffComment);
        if (!word.empty()) line_ = scan_.line();
        return word;
    }

    // Reads the words that are left of this line.
    void rest_of_line() {
        words_.clear();
        for (auto word = scan_.token_in_line(kOffComment); !word.empty(); word = scan_.token_in_line(kOffComment))
            words_.push_back(word);
    }

    // Reads the words of the next line that has any; false at the end of the text.
    bool next_line() {
        words_.clear();
        for (; !scan_.at_end() && words_.empty(); scan_.next_line()) {
            line_ = scan_.line();
            rest_of_line();
        }
        return !words_.empty();
    }

    // ---- Header

    Done header() {
        TextScanner behind = scan_;
        std::string_view keyword = behind.token(kOffComment);
        if (keyword.empty()) return wrong("does not begin with OFF", "check that it is an OFF file");
        if (integer_from<std::uint64_t>(keyword)) return counts("");  // the keyword is missing
        scan_ = behind;
        line_ = scan_.line();
        take_kind(keyword);
        if (keyword.size() < 3 || !equals_ignoring_case(keyword.substr(0, 3), "off")) {
            return wrong("does not begin with OFF, or with a kind of OFF other than [ST][C][N]OFF",
                         "convert it to PLY");
        }
        return counts(keyword.substr(3));  // the counts may stand right behind it
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

    // Reads the counts of vertices, faces and edges, of which the last may be missing.
    Done counts(std::string_view first) {
        if (first.empty()) first = next_word();
        if (first.empty()) return wrong("ends before its counts");
        if (equals_ignoring_case(first, "binary")) return wrong("is a binary OFF file", "convert it to PLY");
        const TextScanner behind_first = scan_;
        rest_of_line();
        words_.insert(words_.begin(), first);
        if (layout_.counts_edges) {  // vertices may follow in the same line
            words_ = {first};
            scan_ = behind_first;
            while (words_.size() < kCounts) words_.push_back(next_word());
        }
        while (words_.size() < kCounts && take_short_line(kCounts - words_.size())) {
        }
        std::array<std::uint64_t, kCounts> counts{};
        for (std::size_t i = 0; i < std::min(words_.size(), kCounts); ++i) {
            const auto value = integer_from<std::uint64_t>(words_[i]);
            if (!value) return wrong(in_quotes(words_[i]) + " stands where a count should");
            counts[i] = *value;
        }
        if (words_.size() < 2 || words_.size() > kCounts) {
            return wrong("has " + std::to_string(words_.size()) + " counts in a line",
                         "write the numbers of vertices, faces and edges into one line");
        }
        return check_counts(counts[0], counts[1]);
    }

    // Adds the words of the next line to those of this one, if they are at most so many.
    bool take_short_line(std::size_t most) {
        TextScanner next = scan_;
        std::vector<std::string_view> words{next.token(kOffComment)};
        for (auto word = next.token_in_line(kOffComment); !word.empty(); word = next.token_in_line(kOffComment))
            words.push_back(word);
        if (words.size() > most || !integer_from<std::uint64_t>(words.front())) return false;
        words_.insert(words_.end(), words.begin(), words.end());
        scan_ = next;
        return true;
    }

    Done check_counts(std::uint64_t vertices, std::uint64_t faces) {
        vertices_ = vertices;
        faces_ = faces;
        // A vertex takes at least three digits and three blanks, a face a digit and a blank; allows a little less for
        // the file's end.
        const std::uint64_t room = (text_.size() - scan_.position()) / 2 + 1;
        if (vertices_ > room / 3 + 1 || faces_ > room || vertices_ * 3 + faces_ > room + 3) {
            return wrong("claims " + std::to_string(vertices_) + " vertices and " + std::to_string(faces_) +
                         " faces, more than the file can hold");
        }
        TextScanner rest = scan_;
        for (std::uint64_t lines = 0; lines <= vertices_ + faces_ && !rest.token(kOffComment).empty(); rest.next_line())
            lines_behind_counts_ = ++lines;
        return {};
    }

    // Tells whether the lines are as many as vertices and faces: then each is to be one of these.
    [[nodiscard]] bool has_a_line_for_each_row() const { return lines_behind_counts_ == vertices_ + faces_; }

    // ---- Vertices

    Done vertices_in_lines() {
        scan_.next_line();
        while (soup_.positions.size() < vertices_) {
            BURIN_TRY_DO(vertex_of_a_line());
        }
        return {};
    }

    Done vertex_of_a_line() {
        if (!next_line()) return wrong("ends in the middle of its vertices");
        const std::size_t before = has_normals_ ? 6 : 3, behind = has_texture_ ? 2 : 0;
        if (words_.size() < before + behind) return wrong("a vertex has " + numbers(words_.size()) + ", too few");
        const std::size_t colour_numbers = words_.size() - before - behind;
        if (colour_numbers > (has_colours_ ? kMostColourNumbers : 0)) {
            return wrong("a vertex has " + numbers(words_.size()) + ", too many",
                         has_colours_ ? kOneALine : "write one vertex a line, and COFF or NOFF for colours or normals");
        }
        return vertex(before, colour_numbers);
    }

    Done vertices_anyhow() {
        if (has_a_line_for_each_row()) return wrong("a line is no vertex", kOneALine);
        const std::size_t before = has_normals_ ? 6 : 3, behind = has_texture_ ? 2 : 0;
        const std::size_t colour_numbers = has_colours_ ? layout_.colour_numbers : 0;
        while (soup_.positions.size() < vertices_) {
            words_.clear();
            while (words_.size() < before + colour_numbers + behind) {
                words_.push_back(next_word());
                if (words_.back().empty()) return wrong("ends in the middle of its vertices");
            }
            BURIN_TRY_DO(vertex(before, colour_numbers));
        }
        return {};
    }

    // Takes the words for a vertex, of which so many stand before its colour.
    Done vertex(std::size_t before, std::size_t colour_numbers) {
        Vec3 p;
        for (std::size_t k = 0; k < words_.size(); ++k) {
            const auto value = number_from(words_[k]);
            if (!value) return wrong(in_quotes(words_[k]) + " is not a number");
            if (k >= 3) continue;
            p[static_cast<int>(k)] = *value;
            if (coordinate_fault(*value) == nullptr) soup_.precision.see(words_[k], *value);
        }
        add_vertex(soup_, p, line_);
        if (!has_colours_) return {};
        most_colour_numbers_ = std::max(most_colour_numbers_, colour_numbers);
        colours_differ_ = colours_differ_ || colour_numbers < most_colour_numbers_;
        return colour(before, colour_numbers, soup_.positions.size() - 1, vertex_colours_);
    }

    static std::string numbers(std::size_t count) {
        return std::to_string(count) + (count == 1 ? " number" : " numbers");
    }

    // ---- Faces

    Done face() {
        const std::string_view first = next_word();
        if (first.empty()) return wrong_face("ends in the middle of its faces");
        const auto count = integer_from<std::uint32_t>(first);
        if (!count) return wrong_face(in_quotes(first) + " stands where a face's number of corners should");
        const std::uint64_t begins = line_;
        for (std::uint32_t i = 0; i < *count; ++i) {
            const std::string_view word = next_word();
            if (line_ != begins) take_note_of_a_parted_face(begins, *count, i);
            if (word.empty())
                return wrong_face("a face of " + std::to_string(*count) + " corners names " + std::to_string(i));
            const auto index = integer_from<std::uint32_t>(word);
            if (!index) return wrong_face(in_quotes(word) + " is not a vertex index");
            if (*index >= vertices_) {
                return wrong_face("a face names vertex " + std::to_string(*index) + ", but there are only " +
                                      std::to_string(vertices_) + " (counted from 0)",
                                  "repair the file");
            }
            soup_.corners.push_back(*index);
        }
        soup_.corner_counts.push_back(*count);
        const bool is_whole = line_ == begins;
        rest_of_line();
        if (is_whole && !colour_of_whole_) colour_of_whole_ = words_.size();
        if (!is_whole && !colour_of_parted_) colour_of_parted_ = words_.size();
        return colour(0, words_.size(), soup_.corner_counts.size() - 1, face_colours_);
    }

    // The first face that goes over lines, which is what a corner too few looks like.
    void take_note_of_a_parted_face(std::uint64_t line, std::uint32_t corners, std::uint32_t names) {
        if (parted_line_ > 0) return;
        parted_line_ = line;
        parted_ = "a face of " + std::to_string(corners) + " corners names " + std::to_string(names);
    }

    // What is wrong behind a face that goes over lines may follow from that one.
    std::unexpected<Error> wrong_face(const std::string& what, const char* remedy = kTruncatedRemedy) const {
        if (parted_line_ == 0) return wrong(what, remedy);
        return fail(at_line(name_, parted_line_),
                    parted_ + " in its line, and with those of the next lines the counts do not fit: line " +
                        std::to_string(line_) + " " + what,
                    "give each face all of its corners");
    }

    Done end() {
        const bool is_odd = colour_of_whole_ && colour_of_parted_ && *colour_of_whole_ != *colour_of_parted_;
        if (parted_line_ > 0 && (is_odd || has_a_line_for_each_row())) {
            line_ = parted_line_;
            return wrong(parted_, "give each face all of its corners");
        }
        if (next_word().empty()) return {};
        if (parted_line_ > 0) return wrong_face("stands behind the last face");
        if (!layout_.keeps_to_lines || colours_differ_) return wrong("text stands behind the last face", kOneALine);
        soup_.report.remarks.push_back("text after the last face was ignored");
        return {};
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
    const OffLayout layout_;
    std::vector<std::string_view> words_;  // of the line or the vertex read last
    std::uint64_t line_ = 1;
    MeshSoup soup_;
    ColourMaterials materials_{soup_.materials};
    std::vector<FileColour> vertex_colours_, face_colours_;
    ColourScale with_point_, whole_;
    bool has_texture_ = false, has_colours_ = false, has_normals_ = false;
    std::uint64_t vertices_ = 0, faces_ = 0, uncoloured_ = 0;
    std::uint64_t lines_behind_counts_ = 0;  // that are not empty, up to one more than rows
    std::uint64_t parted_line_ = 0;          // of the first face that goes over lines; 0: none does
    std::string parted_;                     // what that line lacks
    // Of the first face in one line, and of the first that goes over lines: how many numbers its colour has.
    std::optional<std::size_t> colour_of_whole_, colour_of_parted_;
    std::size_t most_colour_numbers_ = 0;  // of a vertex
    bool colours_differ_ = false;          // the vertices' in their number of numbers
};

}  // namespace

Result<MeshSoup> read_off(std::string_view text, const std::string& name) {
    Result<MeshSoup> in_lines = OffReader(text, name, {}).read();
    if (in_lines) return in_lines;
    for (const bool counts_edges : {true, false})
        for (const std::size_t colour_numbers :
             {std::size_t{4}, std::size_t{3}}) {  // 4 by Geomview's definition; many programs write 3
            Result<MeshSoup> anyhow = OffReader(text, name, {false, colour_numbers, counts_edges}).read();
            if (anyhow) return anyhow;
        }
    return in_lines;
}

}  // namespace burin::geometry
