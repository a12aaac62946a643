// SPDX-License-Identifier: MIT
#include "tests/house/source_tree.hpp"

#include <stdio.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

namespace burin::house {
namespace fs = std::filesystem;

namespace {

constexpr std::array kSourceEndings{".cpp",  ".hpp",  ".h",    ".glsl", ".comp", ".vert",
                                    ".frag", ".geom", ".mesh", ".task", ".cc",   ".c"};

bool is_left_aside(const fs::path& relative) {
    const std::string name = relative.filename().string();
    const bool at_top = !relative.has_parent_path();
    return (at_top && (name == "build" || name == "out")) || (name.starts_with('.') && name != ".ci");
}

}  // namespace

std::vector<std::string> all_files(const fs::path& root) {
    std::vector<std::string> files;
    std::error_code ignored;  // a file that vanishes while we look is not there
    for (auto it = fs::recursive_directory_iterator(root, ignored); it != fs::recursive_directory_iterator();
         it.increment(ignored)) {
        const fs::path relative = it->path().lexically_relative(root);
        if (it->is_directory(ignored)) {
            if (is_left_aside(relative)) it.disable_recursion_pending();
        } else if (relative != ".git" && it->is_regular_file(ignored)) {  // a second work tree has a file of this name
            files.push_back(relative.generic_string());
        }
    }
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> repository_files(const fs::path& root) {
    const std::string command = "git -c safe.directory='*' -C '" + root.string() +
                                "' ls-files --cached --others --exclude-standard 2>/dev/null";
    std::string listing;
    if (const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose); pipe) {
        std::array<char, 4096> part{};
        while (fgets(part.data(), part.size(), pipe.get()) != nullptr) listing += part.data();
    }
    if (listing.empty()) return all_files(root);
    std::vector<std::string> files;
    std::istringstream lines(listing);
    for (std::string line; std::getline(lines, line);) {
        if (fs::is_regular_file(root / line)) files.push_back(line);  // deleted but not yet committed: not there
    }
    return files;
}

bool is_source(const std::string& path) {
    return std::ranges::any_of(kSourceEndings, [&](const char* ending) { return path.ends_with(ending); });
}

std::vector<std::string> source_files(const fs::path& root) {
    std::vector<std::string> files = all_files(root);
    std::erase_if(files, [](const std::string& file) { return !is_source(file); });
    return files;
}

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string without_comments(const std::string& source) {
    enum class In { code, text, line_comment, block_comment };
    std::string result = source;
    In in = In::code;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const char here = source[i], next = i + 1 < source.size() ? source[i + 1] : '\0';
        switch (in) {
            case In::code:
                if (here == '"') in = In::text;
                if (here == '/' && next == '/') in = In::line_comment;
                if (here == '/' && next == '*') in = In::block_comment;
                break;
            case In::text:
                if (here == '\\') ++i;
                if (here == '"' || here == '\n') in = In::code;
                continue;
            case In::line_comment:
                if (here == '\n') in = In::code;
                break;
            case In::block_comment:
                if (here == '*' && next == '/') {
                    result[i] = result[i + 1] = ' ';
                    ++i;
                    in = In::code;
                    continue;
                }
                break;
        }
        if ((in == In::line_comment || in == In::block_comment) && here != '\n') result[i] = ' ';
    }
    return result;
}

void write_text(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

ScratchFolder::ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "burin-house-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace burin::house
