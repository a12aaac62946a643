// SPDX-License-Identifier: MIT
#include "tests/house/session_figures.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "tests/house/layer_rules.hpp"
#include "tests/house/source_tree.hpp"

namespace burin::house {
namespace {

bool is_product(const std::string& path) {
    return (path.ends_with(".cpp") || path.ends_with(".hpp")) && !path.starts_with("tests/");
}
std::size_t lines_in(const std::string& text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

// The product's files, what each includes of the others, and all that each reads in the end.
class Reading {
public:
    explicit Reading(const std::filesystem::path& root) {
        for (const std::string& path : repository_files(root)) {
            if (!is_product(path) && !path.starts_with("shaders/shared/")) continue;
            const std::string text = read_text(root / path);
            files_.emplace(path, File{lines_in(text), {}, is_product(path) ? without_comments(text) : std::string()});
            for (const Include& include : includes_of(text)) files_[path].includes.insert(include.name);
        }
    }

    [[nodiscard]] std::set<std::string> read_by(const std::string& path) const {
        std::set<std::string> read;
        std::vector<std::string> next{path};
        while (!next.empty()) {
            const auto file = files_.find(next.back());
            next.pop_back();
            if (file == files_.end()) continue;
            for (const std::string& include : file->second.includes)
                if (files_.contains(include) && read.insert(include).second) next.push_back(include);
        }
        return read;
    }
    // Returns the lines of our own headers that a source of the folder reads in the mean.
    [[nodiscard]] double mean_lines(const std::string& folder) const {
        double lines = 0.0, sources = 0.0;
        for (const auto& [path, file] : files_) {
            if (!path.starts_with(folder) || !path.ends_with(".cpp")) continue;
            sources += 1.0;
            for (const std::string& header : read_by(path)) lines += static_cast<double>(files_.at(header).lines);
        }
        return sources > 0.0 ? lines / sources : 0.0;
    }
    [[nodiscard]] double sources_that_read(const std::string& header) const {
        return static_cast<double>(std::ranges::count_if(files_, [&](const auto& file) {
            return file.first.ends_with(".cpp") && read_by(file.first).contains(header);
        }));
    }
    [[nodiscard]] std::vector<std::string> includes_up(const std::string& from, const std::string& to) const {
        std::vector<std::string> found;
        for (const auto& [path, file] : files_)
            if (path.starts_with(from))
                for (const std::string& include : file.includes)
                    if (include.starts_with(to)) found.push_back(path + " includes " + include);
        return found;
    }
    // Returns the files in which a pattern is found, but for those whose paths begin with one of `apart`.
    [[nodiscard]] std::vector<std::string> files_with(const std::string& pattern,
                                                      const std::vector<std::string>& apart = {}) const {
        const std::regex wanted(pattern);
        std::vector<std::string> found;
        for (const auto& [path, file] : files_)
            if (std::ranges::none_of(apart, [&](const std::string& folder) { return path.starts_with(folder); }))
                for (std::sregex_iterator at(file.code.begin(), file.code.end(), wanted), end; at != end; ++at)
                    found.push_back(path);
        return found;
    }
    [[nodiscard]] std::size_t lines_of(const std::string& beginning) const {
        std::size_t lines = 0;
        for (const auto& [path, file] : files_)
            if (path.starts_with(beginning)) lines += file.lines;
        return lines;
    }

private:
    struct File {
        std::size_t lines = 0;
        std::set<std::string> includes;
        std::string code;  // of a product's file, without comments
    };
    std::map<std::string, File> files_;
};

}  // namespace

std::vector<std::string> private_members(const std::string& source, const std::string& type) {
    const std::string text = without_comments(source);
    std::vector<std::string> members;
    const std::size_t begin = text.find("class " + type + " ");
    const std::size_t open = begin == std::string::npos ? begin : text.find("\nprivate:", begin);
    if (open == std::string::npos) return members;
    std::istringstream lines(text.substr(open, text.find("\n};", open) - open));
    // A declaration stands on a line of its own: a type, names that end in an underscore, an initialiser, a semicolon.
    const std::regex name(R"([ *&](\w+_)\s*(?=[,;={]))");
    for (std::string line; std::getline(lines, line);) {
        if (line.contains('(') && !line.contains("};")) continue;  // a function
        for (std::sregex_iterator at(line.begin(), line.end(), name), end; at != end; ++at) members.push_back((*at)[1]);
    }
    return members;
}

std::vector<Figure> session_figures(const std::filesystem::path& root) {
    const Reading reading(root);
    std::vector<Figure> figures;
    std::vector<std::string> up = reading.includes_up("session/", "desk/");
    figures.push_back({"includes from session/ up to desk/", static_cast<double>(up.size()), 0.0, std::move(up), ""});
    // What goes round the session, and how far carving is still every session's nature (bars: what is reached).
    std::vector<std::string> carving = reading.includes_up("session/", "sculpt/");
    std::ranges::move(reading.includes_up("desk/", "sculpt/"), std::back_inserter(carving));
    const auto count = [&figures](std::string what, std::vector<std::string> found, double bar) {
        figures.push_back({std::move(what), static_cast<double>(found.size()), bar, std::move(found), ""});
    };
    count("includes of sculpt/ in session/ and desk/", std::move(carving), 0.0);
    count("uses of one struct for all options", reading.files_with("\\bSculptOptions\\b"), 0.0);
    count("haptic loops made outside of session/hands/",
          reading.files_with("\\bHapticLoop loop_?[({;]", {"session/hands/", "haptics/", "bench/"}), 0.0);
    count("ticks that study/ computes by itself",
          reading.files_with("\\bfull_tick\\(", {"haptics/", "bench/", "docs/"}), 0.0);
    std::vector<std::string> members = private_members(read_text(root / "session/live/session.hpp"), "Session");
    figures.push_back({"members of a Session", static_cast<double>(members.size()), 12.0, std::move(members), ""});
    std::vector<std::string> of_desk = private_members(read_text(root / "desk/live/desk.hpp"), "Desk");
    figures.push_back({"members of a Desk", static_cast<double>(of_desk.size()), 18.0, std::move(of_desk), ""});
    double lines = 0.0;
    for (const char* const file : {"session.hpp", "session.cpp", "session_opening.cpp"})
        lines += static_cast<double>(reading.lines_of(std::string("session/live/") + file));
    figures.push_back({"lines of a Session", lines, 372.0, {}, ""});
    figures.push_back({"sources that read haptics/channels.hpp",
                       reading.sources_that_read("haptics/channels.hpp"),
                       34.0,
                       {},
                       "of the product"});
    for (const auto& [folder, bar] :
         {std::pair("session/", 4395.0), std::pair("desk/", 6300.0), std::pair("app/", 4160.0)})
        figures.push_back({std::string("lines of our headers that a source reads in ") + folder,
                           reading.mean_lines(folder),
                           bar,
                           {},
                           "in the mean"});
    return figures;
}

}  // namespace burin::house
