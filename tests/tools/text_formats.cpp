// SPDX-License-Identifier: MIT
// ASCII STL, OBJ and OFF.
#include <charconv>
#include <cstdlib>
#include <optional>

#include "tests/tools/audited_file.hpp"

namespace mesh_audit {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// Takes text apart line by line and word by word.
class Words {
public:
    explicit Words(std::string_view text) : rest_(text) {}

    // Goes to the next line; false at the end. A word of the line before that was not taken is dropped.
    bool next_line() {
        if (rest_.empty()) return false;
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        line_ = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++number_;
        return true;
    }

    // The next word of this line; empty at its end.
    std::string_view word() {
        std::size_t from = 0;
        while (from < line_.size() && is_blank(line_[from])) ++from;
        std::size_t to = from;
        while (to < line_.size() && !is_blank(line_[to])) ++to;
        const std::string_view found = line_.substr(from, to - from);
        line_.remove_prefix(to);
        return found;
    }

    // The next word anywhere, '#' comments left aside; empty at the end of the text.
    std::string_view word_across_lines() {
        while (true) {
            const std::string_view found = word();
            if (!found.empty() && found[0] != '#') return found;
            if (!next_line()) return {};
        }
    }

    [[nodiscard]] std::string complaint(const std::string& what) const {
        return "line " + std::to_string(number_) + ": " + what;
    }

private:
    std::string_view rest_, line_;
    std::size_t number_ = 0;
};

std::optional<double> number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

std::optional<long long> integer(std::string_view word) {
    long long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

std::optional<Point> point(Words& words) {
    const auto x = number(words.word()), y = number(words.word()), z = number(words.word());
    if (!x || !y || !z) return std::nullopt;
    return Point{*x, *y, *z};
}

}  // namespace

Reading read_ascii_stl(std::string_view content) {
    Reading reading;
    reading.mesh.format = "ASCII STL";
    Words words(content);
    std::size_t corners_in_loop = 0;
    while (words.next_line()) {
        const std::string_view keyword = words.word();
        if (keyword == "vertex") {
            const auto corner = point(words);
            if (!corner) return {{}, {words.complaint("a vertex needs three numbers")}};
            // ASCII STL is written from floats; the same float is the same point however it was printed.
            const auto rounded = [](double value) { return static_cast<double>(static_cast<float>(value)); };
            reading.mesh.points.push_back({rounded(corner->x), rounded(corner->y), rounded(corner->z)});
            ++corners_in_loop;
        } else if (keyword == "endloop") {
            if (corners_in_loop != 3) return {{}, {words.complaint("a loop needs three vertices")}};
            corners_in_loop = 0;
        }
    }
    if (corners_in_loop != 0) return {{}, {words.complaint("ends inside a loop")}};
    weld_by_bits(reading.mesh);
    return reading;
}

Reading read_obj(std::string_view content) {
    Reading reading;
    reading.mesh.format = "OBJ";
    Mesh& mesh = reading.mesh;
    Words words(content);
    std::vector<std::uint64_t> corners;
    while (words.next_line()) {
        const std::string_view keyword = words.word();
        if (keyword == "v") {
            const auto vertex = point(words);
            if (!vertex) return {{}, {words.complaint("a vertex needs three numbers")}};
            mesh.points.push_back(*vertex);
        } else if (keyword == "f") {
            corners.clear();
            for (std::string_view word = words.word(); !word.empty() && word[0] != '#'; word = words.word()) {
                const auto index = integer(word.substr(0, word.find('/')));
                const auto count = static_cast<long long>(mesh.points.size());
                if (!index || *index == 0 || *index > count || *index < -count) {
                    return {{}, {words.complaint("'" + std::string(word) + "' names no vertex above it")}};
                }
                corners.push_back(static_cast<std::uint64_t>(*index > 0 ? *index - 1 : count + *index));
            }
            if (corners.size() < 3) return {{}, {words.complaint("a face needs three corners")}};
            if (!append_face(mesh, corners)) return {{}, {words.complaint("a face names no vertex")}};
        }
    }
    return reading;
}

Reading read_off(std::string_view content) {
    Reading reading;
    reading.mesh.format = "OFF";
    Mesh& mesh = reading.mesh;
    Words words(content);
    if (words.word_across_lines() != "OFF") return {{}, {"does not begin with OFF"}};
    const auto vertices = integer(words.word_across_lines()), faces = integer(words.word_across_lines());
    if (!vertices || !faces || *vertices < 0 || *faces < 0) return {{}, {words.complaint("counts expected")}};
    (void)words.word_across_lines();  // the number of edges, which nobody fills in
    for (long long i = 0; i < *vertices; ++i) {
        const auto x = number(words.word_across_lines());
        const auto y = number(words.word()), z = number(words.word());
        if (!x || !y || !z) return {{}, {words.complaint("a vertex needs three numbers")}};
        mesh.points.push_back({*x, *y, *z});
        words.next_line();
    }
    std::vector<std::uint64_t> corners;
    for (long long i = 0; i < *faces; ++i) {
        const auto count = integer(words.word_across_lines());
        corners.clear();
        for (long long c = 0; count && c < *count; ++c) {
            const auto index = integer(words.word());
            if (!index || *index < 0) break;
            corners.push_back(static_cast<std::uint64_t>(*index));
        }
        if (!count || *count < 3 || corners.size() != static_cast<std::size_t>(*count) || !append_face(mesh, corners)) {
            return {{}, {words.complaint("a face needs a count and as many indices of vertices")}};
        }
        words.next_line();
    }
    return reading;
}

}  // namespace mesh_audit
