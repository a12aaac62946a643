// SPDX-License-Identifier: MIT
#include "tests/house/test_names.hpp"

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/house/source_tree.hpp"

namespace burin::house {
namespace {

bool is_defined(const std::string& named, const std::set<std::string>& defined) {
    if (!named.ends_with('*')) return defined.contains(named);
    const std::string begins = named.substr(0, named.size() - 1);
    const auto first = defined.lower_bound(begins);
    return first != defined.end() && first->starts_with(begins);
}

}  // namespace

std::set<std::string> tests_defined_in(const std::string& source) {
    static const std::regex kTest(R"((?:TEST|TEST_F|TEST_P|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\(\s*(\w+),\s*(\w+))");
    std::set<std::string> names;
    for (std::sregex_iterator at(source.begin(), source.end(), kTest), end; at != end; ++at)
        names.insert((*at)[1].str() + "." + (*at)[2].str());
    return names;
}

std::vector<NamedPath> tests_named_in(const std::string& document) {
    static const std::regex kName(R"(`([A-Z][A-Za-z0-9]*\.[A-Z][A-Za-z0-9]*\*?)`)");
    std::vector<NamedPath> names;
    std::istringstream lines(document);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
        for (std::sregex_iterator at(line.begin(), line.end(), kName), end; at != end; ++at)
            names.push_back({(*at)[1].str(), number});
    return names;
}

Findings missing_tests(const std::filesystem::path& root) {
    const std::vector<std::string> files = repository_files(root);
    std::set<std::string> defined;
    for (const std::string& path : files)
        if (path.starts_with("tests/") && path.ends_with(".cpp"))
            defined.merge(tests_defined_in(read_text(root / path)));
    Findings found;
    for (const std::string& path : files) {
        if (!path.ends_with(".md")) continue;
        for (const NamedPath& named : tests_named_in(read_text(root / path))) {
            ++found.looked_at;
            if (!is_defined(named.path, defined))
                found.places.push_back(path + ":" + std::to_string(named.line) + ": names " + named.path);
        }
    }
    return found;
}

}  // namespace burin::house
