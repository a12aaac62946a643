// SPDX-License-Identifier: MIT
#include "tests/house/house_figures.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "tests/house/house_rules.hpp"
#include "tests/house/session_figures.hpp"
#include "tests/house/source_tree.hpp"
#include "tests/house/structure_rules.hpp"

namespace burin::house {

namespace {

bool is_cpp(const std::string& path) { return path.ends_with(".cpp") || path.ends_with(".hpp"); }

std::string top_folder_of(const std::string& path) { return path.substr(0, path.find('/')); }

Figure counted(std::string name, std::vector<std::string> places) {
    const auto count = static_cast<double>(places.size());
    return {std::move(name), count, 0.0, std::move(places), ""};
}

// Counts what a kind of device touches: its own source, and the other files of the product that name it.
Figure places_touched(const std::filesystem::path& root, const std::string& what, const std::string& own_source,
                      const std::string& opened_by, double bar) {
    Figure figure{"places that a " + what + " touches", 0.0, bar, {own_source}, "as " + own_source + " does"};
    for (const std::string& path : repository_files(root)) {
        const bool judged = is_cpp(path) && !path.starts_with("tests/") && !path.starts_with(own_source);
        if (judged && without_comments(read_text(root / path)).contains(opened_by)) figure.places.push_back(path);
    }
    figure.value = static_cast<double>(figure.places.size());
    return figure;
}

// Counts the files that lie in a folder itself, and not in one of its rooms.
Figure flat_files(const std::filesystem::path& root, const std::string& folder, double bar) {
    Figure figure{"flat files of " + folder, 0.0, bar, {}, ""};
    for (const std::string& path : repository_files(root))
        if (path.starts_with(folder) && !path.substr(folder.size()).contains('/')) figure.places.push_back(path);
    figure.value = static_cast<double>(figure.places.size());
    return figure;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::size_t indent_of(const std::string& line) { return std::min(line.find_first_not_of(' '), line.size()); }

// Returns whether a function's body, or a lambda's at a statement's end, may begin behind this line, as clang-format
// lays it out: it ends with a brace, and is indented by no more than a member is.
bool opens_function(const std::string& line) {
    if (!line.ends_with('{') || !line.contains(')') || indent_of(line) > 4 || line.starts_with('}')) return false;
    const std::string begins = line.substr(indent_of(line));
    for (const char* other : {"if ", "for ", "while ", "switch ", "namespace", "struct ", "class ", "enum "})
        if (begins.starts_with(other)) return false;
    return true;
}

// Finds the longest function of a folder, in lines from the one that opens its body to the one that closes it.
Figure longest_function(const std::filesystem::path& root, const std::string& folder, double bar) {
    Figure figure{"lines of the longest function in " + folder, 0.0, bar, {}, ""};
    for (const std::string& path : repository_files(root)) {
        if (!is_cpp(path) || !path.starts_with(folder)) continue;
        const std::vector<std::string> lines = lines_of(read_text(root / path));
        for (std::size_t first = 0; first < lines.size(); ++first) {
            if (!opens_function(lines[first])) continue;
            std::size_t last = first + 1;
            const std::string end = std::string(indent_of(lines[first]), ' ') + '}';
            while (last + 1 < lines.size() && !lines[last].starts_with(end)) ++last;
            const auto length = static_cast<double>(last - first + 1);
            if (length <= figure.value) continue;
            figure.value = length;
            figure.places = {formatted("%s:%zu", path.c_str(), first + 1)};
            figure.remark = figure.places.front();
        }
    }
    return figure;
}

}  // namespace

std::vector<FolderFragments> fragments_by_folder(const std::filesystem::path& root) {
    std::map<std::string, FolderFragments> folders;
    for (const std::string& path : repository_files(root)) {
        const std::string folder = top_folder_of(path);
        if (!is_cpp(path) || !path.contains('/') || folder == "tests" || folder == "shaders") continue;
        FolderFragments& counts = folders[folder];
        counts.folder = folder;
        ++counts.files;
        const std::string text = read_text(root / path);
        if (static_cast<std::size_t>(std::ranges::count(text, '\n')) < kFragmentLines) counts.fragments.push_back(path);
    }
    std::vector<FolderFragments> found;
    for (auto& [folder, counts] : folders) found.push_back(std::move(counts));
    return found;
}

std::vector<Figure> house_figures(const std::filesystem::path& root) {
    std::vector<Figure> figures;
    figures.push_back(counted("types defined twice in a namespace", types_defined_twice(root)));
    figures.push_back(counted("cycles between rooms", room_cycles(root)));
    figures.push_back(counted(formatted("lines of more than %d columns", kMostColumns), long_lines(root).places));
    figures.push_back(counted("paths in documents that do not exist", missing_document_paths(root).places));
    figures.push_back(counted("paths in comments that do not exist", missing_comment_paths(root).places));
    figures.push_back(places_touched(root, "tracker", "devices/trackers/udp_tracker", "open_udp_tracker", 3.0));
    figures.push_back(
        places_touched(root, "haptic device", "devices/haptic/simulated_omni", "open_simulated_omni", 3.0));
    figures.push_back(flat_files(root, "app/", 12.0));
    figures.push_back(longest_function(root, "app/", 60.0));
    std::ranges::move(session_figures(root), std::back_inserter(figures));
    for (FolderFragments& folder : fragments_by_folder(root)) {
        Figure figure{formatted("%% of files under %zu lines in %s/", kFragmentLines, folder.folder.c_str()),
                      folder.percent(), std::nullopt, std::move(folder.fragments),
                      formatted("%zu files", folder.files)};
        figures.push_back(std::move(figure));
    }
    return figures;
}

std::string table_of(std::span<const Figure> figures) {
    std::string text;
    for (const Figure& figure : figures) {
        const std::string bar = figure.bar ? formatted("bar %4.0f", *figure.bar) : "no bar  ";
        text += formatted("%-6s %-46s %6.1f  %s  %s\n", figure.reached() ? "ok" : "MISSED", figure.name.c_str(),
                          figure.value, bar.c_str(), figure.remark.c_str());
        for (const std::string& place : figure.places)
            if (!figure.reached()) text += "         " + place + "\n";
    }
    return text;
}

}  // namespace burin::house
