// SPDX-License-Identifier: MIT
#include "tests/house/include_rules.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "tests/house/layer_rules.hpp"
#include "tests/house/source_tree.hpp"
#include "tests/house/source_words.hpp"

namespace burin::house {
namespace fs = std::filesystem;

namespace {

// Which header declares a name of the standard library. Left out: what nearly every header of it brings (std::move,
// std::pair, std::size_t), and names that several headers declare.
constexpr const char* kStandardNames = R"(
algorithm: sort stable_sort nth_element lower_bound upper_bound min_element max_element clamp minmax all_of any_of
algorithm: none_of count_if find_if copy_n fill_n reverse rotate partition unique
array: array
atomic: atomic atomic_flag memory_order_acquire memory_order_release memory_order_relaxed
bit: bit_cast popcount countr_zero bit_width endian
charconv: from_chars to_chars
cmath: sqrt isfinite isnan floor ceil hypot lround llround pow exp log sin cos tan atan2 fmod nextafter cbrt trunc
condition_variable: condition_variable
cstdint: uint64_t uint32_t uint8_t uint16_t int64_t int32_t
cstring: memcpy memcmp memset strlen
deque: deque
expected: expected unexpected
filesystem: filesystem
fstream: ifstream ofstream
functional: function invoke
future: future async promise
limits: numeric_limits
map: map multimap
memory: unique_ptr shared_ptr make_unique make_shared weak_ptr
mutex: mutex lock_guard unique_lock scoped_lock once_flag
numbers: numbers
numeric: accumulate iota gcd partial_sum inner_product transform_reduce
optional: optional nullopt make_optional
random: mt19937 mt19937_64 uniform_real_distribution normal_distribution uniform_int_distribution
set: set multiset
span: span
sstream: ostringstream istringstream stringstream
string: string to_string
string_view: string_view
thread: thread jthread this_thread
tuple: tuple tie make_tuple
unordered_map: unordered_map
unordered_set: unordered_set
utility: exchange to_underlying index_sequence
variant: variant visit get_if holds_alternative monostate
vector: vector
)";

// Namespaces of libraries, and how the names of their headers begin.
const std::map<std::string, std::string> kLibraries{
    {"glm", "glm/"},      {"Eigen", "Eigen/"},   {"CLI", "CLI/"},    {"toml", "toml++/"},         {"tbb", "tbb/"},
    {"rc", "rapidcheck"}, {"testing", "gtest/"}, {"ImGui", "imgui"}, {"meshopt", "meshoptimizer"}};

std::map<std::string, std::string> standard_names() {
    std::map<std::string, std::string> headers;
    std::istringstream lines(kStandardNames);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string header;
        words >> header;
        if (!header.empty()) header.pop_back();
        for (std::string name; words >> name;) headers[name] = header;
    }
    return headers;
}

// Texts that their users include inside a struct, as their first lines say; they mean nothing alone.
constexpr std::array<std::string_view, 5> kInsideOthers{"shaders/shared/cell_pieces.h",
                                                        "shaders/shared/feature_point.h", "shaders/shared/join_parts.h",
                                                        "shaders/shared/ray_crossing.h", "shaders/shared/span_edit.h"};

// Functions of the system's library whose names functions of the tree have too.
constexpr std::array<std::string_view, 2> kOfTheSystem{"read", "write"};

// Texts for GLSL call what that language has built in.
bool knows_functions(const std::string& file) { return !file.ends_with(".h"); }

bool is_header(const std::string& file) { return file.ends_with(".hpp") || file.ends_with(".h"); }

bool is_type_or_constant(const std::string& name) {
    const auto is_upper = [&](std::size_t i) {
        return i < name.size() && std::isupper(static_cast<unsigned char>(name[i])) != 0;
    };
    return is_upper(0) || (name[0] == 'k' && is_upper(1));
}

// What is known of a file of the tree.
struct ReadFile {
    std::string name;
    std::vector<SourceWord> words;
    std::vector<Include> includes;
    std::set<std::string> mentioned;
};

// A use of a name: at(word) and what stands around it.
class Use {
public:
    Use(const std::vector<SourceWord>& words, std::size_t i) : words_(words), i_(i) {}

    [[nodiscard]] const std::string& name() const { return words_[i_].text; }
    [[nodiscard]] int line() const { return words_[i_].line; }
    [[nodiscard]] bool is_of_member() const { return text(-1) == "." || text(-1) == "->"; }
    // The name before "::"; empty: there is none.
    [[nodiscard]] const std::string& qualifier() const { return text(-1) == "::" ? text(-2) : none_; }
    [[nodiscard]] bool is_called() const { return text(1) == "("; }
    // The file itself introduces the name here: a type, a variable, a function, a test, a parameter of a template. As
    // generous as the rule: a product "a * f(x)" passes for a declaration of f.
    [[nodiscard]] bool is_declared() const {
        static const std::set<std::string> introducing{"struct",  "class",    "enum",      "union", "using",
                                                       "concept", "typename", "namespace", "define"};
        static const std::set<std::string> after{"=", "(", "{", "[", ";", ",", ")", ":", ">"};
        if (introducing.contains(text(-1))) return true;
        if (text(-1) == "(" && text(-2) == "TEST") return true;
        if (!after.contains(text(1))) return false;
        if (name()[0] == 'k' && (text(1) == "=" || text(1) == "{")) return true;
        return follows_type() || goes_on_declaration();
    }

private:
    [[nodiscard]] bool follows_type() const {
        static const std::set<std::string> going_on{"return", "else",     "case",     "co_return", "throw",
                                                    "new",    "co_yield", "do",       "and",       "or",
                                                    "not",    "const",    "constexpr"};
        int step = -1;
        while (text(step) == "*" || text(step) == "&") --step;
        return text(step) == ">" || (is_identifier(text(step)) && !going_on.contains(text(step)));
    }

    // The second of "Plate painted(4), bent(4);": after a comma that stands in no parenthesis.
    [[nodiscard]] bool goes_on_declaration() const {
        if (text(-1) != ",") return false;
        int open = 0;
        for (int step = -2; !text(step).empty(); --step) {
            const std::string& word = text(step);
            if (word == ";" || word == "{") break;
            open += word == "(" ? 1 : word == ")" ? -1 : 0;
        }
        return open <= 0;
    }

    [[nodiscard]] const std::string& text(int step) const {
        const std::size_t at = i_ + static_cast<std::size_t>(step);
        return at < words_.size() ? words_[at].text : none_;
    }

    const std::vector<SourceWord>& words_;
    std::size_t i_;
    inline static const std::string none_{};
};

class IncludeChecker {
public:
    explicit IncludeChecker(fs::path root) : root_(std::move(root)), standard_(standard_names()) {
        for (const std::string& file : source_files(root_)) {
            if (!is_header(file) && !file.ends_with(".cpp")) continue;
            const std::string source = read_text(root_ / file);
            numbers_[file] = files_.size();
            files_.push_back({file, words_of_source(source), includes_of(source), {}});
        }
        for (ReadFile& file : files_) note_names(file);
    }

    std::vector<std::string> violations() {
        for (const ReadFile& file : files_)
            if (std::ranges::find(kInsideOthers, file.name) == kInsideOthers.end()) check(file);
        std::ranges::sort(found_);
        return std::move(found_);
    }

private:
    void note_names(ReadFile& file) {
        for (const SourceWord& word : file.words)
            if (is_identifier(word.text)) file.mentioned.insert(word.text);
        for (std::size_t i = 0; i + 1 < file.words.size(); ++i)
            if (file.words[i].text == "namespace") note_namespace(file.words, i + 1);
        if (!is_header(file.name)) return;
        for (const std::string& name : declared_names(file.words))
            if (std::ranges::find(kOfTheSystem, name) == kOfTheSystem.end()) declared_.try_emplace(name, file.name);
    }

    // "namespace burin::study {" names two; an alias of somebody's namespace ("namespace fs = ...") names none.
    void note_namespace(const std::vector<SourceWord>& words, std::size_t i) {
        std::size_t end = i;
        while (end < words.size() && (is_identifier(words[end].text) || words[end].text == "::")) ++end;
        if (end == words.size() || words[end].text != "{") return;
        for (; i < end; ++i)
            if (is_identifier(words[i].text)) namespaces_.insert(words[i].text);
    }

    struct Reached {
        std::vector<const ReadFile*> headers;  // of the tree
        std::set<std::string> outside;         // by the names in their #include lines
    };

    Reached reached_from(const ReadFile& file) const {
        Reached reached;
        std::set<std::size_t> seen{numbers_.at(file.name)};
        std::vector<const ReadFile*> waiting{&file};
        while (!waiting.empty()) {
            const ReadFile& current = *waiting.back();
            waiting.pop_back();
            for (const Include& include : current.includes) {
                const std::optional<std::size_t> number = number_of(current.name, include);
                if (!number) reached.outside.insert(include.name);
                if (!number || !seen.insert(*number).second) continue;
                reached.headers.push_back(&files_[*number]);
                waiting.push_back(&files_[*number]);
            }
        }
        return reached;
    }

    std::optional<std::size_t> number_of(const std::string& including, const Include& include) const {
        for (const fs::path& path : {fs::path(including).parent_path() / include.name, fs::path(include.name)}) {
            const auto found = numbers_.find(path.lexically_normal().generic_string());
            if (found != numbers_.end()) return found->second;
        }
        return {};
    }

    void check(const ReadFile& file) {
        const Reached reached = reached_from(file);
        std::set<std::string> told, own;
        for (std::size_t i = 0; i < file.words.size(); ++i)
            if (is_identifier(file.words[i].text) && Use(file.words, i).is_declared()) own.insert(file.words[i].text);
        for (std::size_t i = 0; i < file.words.size(); ++i) {
            if (!is_identifier(file.words[i].text)) continue;
            const Use use(file.words, i);
            const std::string missing = missing_for(use, file, own, reached);
            if (missing.empty() || !told.insert(use.name()).second) continue;
            found_.push_back(file.name + ":" + std::to_string(use.line()) + ": uses " + use.name() + missing);
        }
    }

    std::string missing_for(const Use& use, const ReadFile& file, const std::set<std::string>& own,
                            const Reached& reached) const {
        const std::string& qualifier = use.qualifier();
        if (qualifier == "std" || qualifier == "ranges") return missing_standard(use, reached);
        if (const auto library = kLibraries.find(qualifier); library != kLibraries.end()) {
            if (own.contains(use.name())) return {};  // declared forward
            const auto is_of = [&](const std::string& header) { return header.starts_with(library->second); };
            return std::ranges::any_of(reached.outside, is_of) ? "" : " of " + qualifier + " and includes none of it";
        }
        return missing_of_tree(use, file, own, reached);
    }

    std::string missing_standard(const Use& use, const Reached& reached) const {
        const auto found = standard_.find(use.name());
        if (found == standard_.end() || reached.outside.contains(found->second)) return {};
        return " and includes <" + found->second + "> nowhere";
    }

    std::string missing_of_tree(const Use& use, const ReadFile& file, const std::set<std::string>& own,
                                const Reached& reached) const {
        const auto found = declared_.find(use.name());
        if (found == declared_.end() || own.contains(use.name()) || use.is_of_member()) return {};
        if (!use.qualifier().empty() && !namespaces_.contains(use.qualifier())) return {};
        if (!is_type_or_constant(use.name()) && !(use.is_called() && knows_functions(file.name))) return {};
        const auto mentions = [&](const ReadFile* header) { return header->mentioned.contains(use.name()); };
        if (found->second == file.name || std::ranges::any_of(reached.headers, mentions)) return {};
        return " of " + found->second + ", which no header that it includes mentions";
    }

    fs::path root_;
    std::map<std::string, std::string> standard_;
    std::vector<ReadFile> files_;
    std::map<std::string, std::size_t> numbers_;
    std::map<std::string, std::string> declared_;  // a header that declares the name
    std::set<std::string> namespaces_;
    std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> include_violations(const fs::path& root) { return IncludeChecker(root).violations(); }

}  // namespace burin::house
