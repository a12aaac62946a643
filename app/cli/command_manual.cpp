// SPDX-License-Identifier: MIT
#include "app/cli/command_manual.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "base/assets.hpp"
#include "base/text.hpp"

namespace burin::app {
namespace {

// ---- What the commands are

std::vector<const CLI::App*> commands_of(const CLI::App& of) { return of.get_subcommands({}); }

// "burin", "burin study run"
std::string full_name(const CLI::App& of) {
    return of.get_parent() == nullptr ? "burin" : full_name(*of.get_parent()) + " " + of.get_name();
}

std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() != 0; }

// Returns what stands between the first braces of an option's type: the words that it takes.
std::vector<std::string> words_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t begin = type.find('{'), end = type.find('}', begin);
    std::vector<std::string> words;
    if (begin == std::string::npos || end == std::string::npos) return words;
    std::string word;
    for (const char c : type.substr(begin + 1, end - begin - 1)) {
        if (c == ' ') continue;
        if (c == ',')
            words.push_back(std::exchange(word, ""));
        else
            word += c;
    }
    words.push_back(word);
    return words;
}

// ---- roff

// Escapes what roff would take for its own; a hyphen is a minus where somebody copies it. A list without blanks may be
// broken behind its commas.
std::string roff(std::string_view text) {
    std::string escaped;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\\') {
            escaped += "\\e";
        } else if (c == '-') {
            escaped += "\\-";
        } else if (c == ',' && i + 1 < text.size() && text[i + 1] != ' ') {
            escaped += ",\\:";
        } else {
            escaped += c == '\n' ? ' ' : c;
        }
    }
    if (escaped.starts_with('.') || escaped.starts_with('\'')) escaped.insert(0, "\\&");
    return escaped;
}

// Formats what stands behind an option's name as the help does.
class ValueFormatter : public CLI::Formatter {
public:
    [[nodiscard]] std::string value(const CLI::Option& option) const { return make_option_opts(&option); }
};

std::string option_text(const CLI::Option& option) {
    std::string names;
    for (const std::string& name : names_of(option)) names += (names.empty() ? "" : ", ") + name;
    if (option.get_positional()) names = option.get_name(true, false) + (names.empty() ? "" : ", " + names);
    return ".TP\n\\fB" + roff(names) + "\\fR" + roff(ValueFormatter().value(option)) + "\n" +
           roff(option.get_description()) + ".\n";
}

std::string synopsis(const CLI::App& of) {
    std::string text = "\\fB" + roff(full_name(of)) + "\\fR [options]";
    for (const CLI::Option* option : of.get_options([](const CLI::Option* o) { return o->get_positional(); })) {
        const std::string name = roff(option->get_name(true, false));
        text += option->get_required() ? " \\fI" + name + "\\fR" : " [\\fI" + name + "\\fR]";
    }
    if (!commands_of(of).empty())
        text += of.get_require_subcommand_min() > 0 ? " \\fIcommand\\fR" : " [\\fIcommand\\fR]";
    return text + " ...\n";
}

std::string options_text(const CLI::App& of) {
    std::string text;
    for (const CLI::Option* option : of.get_options({})) text += option_text(*option);
    return text;
}

// The sections of a command's own commands, theirs behind them.
std::string sections_of_commands(const CLI::App& of) {
    std::string text;
    for (const CLI::App* command : commands_of(of)) {
        std::string title = full_name(*command);
        std::ranges::transform(title, title.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
        text += ".SH \"" + roff(title) + "\"\n" + synopsis(*command) + ".PP\n" + roff(command->get_description()) +
                ".\n" + options_text(*command) + sections_of_commands(*command);
    }
    return text;
}

std::string heading(const CLI::App& of, const std::string& version) {
    std::string name = full_name(of);
    std::ranges::replace(name, ' ', '-');
    std::string title = name;
    std::ranges::transform(title, title.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
    return ".TH " + roff(title) + " 1 \"\" \"Burin " + roff(version) + "\" \"User commands\"\n.ad l\n.nh\n.SH NAME\n" +
           roff(name) + " \\- " + roff(of.get_description()) + "\n.SH SYNOPSIS\n" + synopsis(of) + ".SH DESCRIPTION\n" +
           roff(of.get_description()) + ".\n";
}

std::string closing(bool is_program) {
    std::string text =
        ".SH \"EXIT STATUS\"\n0: done; 1: failed, and one line on standard error says why; 2: wrong usage.\n"
        ".SH ENVIRONMENT\n.TP\n\\fBBURIN_ASSETS\\fR\nThe folder of worlds, workpieces, tools, strokes, sessions, "
        "walls, "
        "trackers and devices that come with the program; else \\fIPREFIX/share/burin\\fR of \\fIPREFIX/bin/burin\\fR. "
        "A "
        "name that is no file is looked for there, with or without its ending: \\fBburin world garden\\fR.\n";
    if (is_program)
        text +=
            ".SH FILES\n.TP\n\\fI/usr/lib/udev/rules.d/70\\-burin\\-devices.rules\\fR\nLets the person at the machine "
            "open force\\-feedback devices.\n";
    return text;
}

std::string program_page(const CLI::App& program, const std::string& version) {
    std::string text = heading(program, version) + ".SH COMMANDS\n", see;
    for (const CLI::App* command : commands_of(program)) {
        text += ".TP\n\\fB" + roff(command->get_name()) + "\\fR\n" + roff(command->get_description()) + ".\n";
        see += (see.empty() ? "" : ",\n") + ("\\fBburin\\-" + roff(command->get_name()) + "\\fR(1)");
    }
    return text + ".SH OPTIONS\n" + options_text(program) + closing(true) + ".SH \"SEE ALSO\"\n" + see + "\n";
}

std::string command_page(const CLI::App& command, const std::string& version) {
    return heading(command, version) + ".SH OPTIONS\n" + options_text(command) + sections_of_commands(command) +
           closing(false) + ".SH \"SEE ALSO\"\n\\fBburin\\fR(1)\n";
}

// ---- bash

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

// Returns the names of the room that an option takes its assets from (CommandOption::asset).
std::vector<std::string> assets_of(const CLI::Option& option) {
    for (const AssetRoom room : kAssetRooms) {
        try {
            (void)const_cast<CLI::Option&>(option).get_validator(room_folder(room));  // finds, changes nothing
            return asset_names(room);
        } catch (const CLI::OptionNotFound&) {
            continue;
        }
    }
    return {};
}

struct CompletionOf {
    std::string commands;  // lines of a case by the path of commands: "/study/run"
    std::string values;    // lines of a case by that path and an option
};

void complete_command(const CLI::App& of, const std::string& path, CompletionOf& to) {
    std::vector<std::string> commands, options, flags, names;
    for (const CLI::App* command : commands_of(of)) commands.push_back(command->get_name());
    for (const CLI::Option* option : of.get_options({})) {
        const std::vector<std::string> assets = assets_of(*option);
        std::vector<std::string> words = words_of(*option);
        words.insert(words.end(), assets.begin(), assets.end());
        if (option->get_positional()) names.insert(names.end(), words.begin(), words.end());
        for (const std::string& name : names_of(*option)) {
            (takes_value(*option) ? options : flags).push_back(name);
            if (!words_of(*option).empty())
                to.values += "    '" + path + " " + name + "') words='" + joined(words) + "'; files=no ;;\n";
            else if (!assets.empty())
                to.values += "    '" + path + " " + name + "') words='" + joined(words) + "' ;;\n";
        }
    }
    to.commands += "    '" + path + "') commands='" + joined(commands) + "' flags='" + joined(flags) + "' options='" +
                   joined(options) + "' names='" + joined(names) + "' ;;\n";
    for (const CLI::App* command : commands_of(of)) complete_command(*command, path + "/" + command->get_name(), to);
}

void list_paths(const CLI::App& of, const std::string& path, std::string& to) {
    for (const CLI::App* command : commands_of(of)) {
        const std::string own = path + "/" + command->get_name();
        to += (to.empty() ? "" : " | ") + own;
        list_paths(*command, own, to);
    }
}

std::string bash_completion(const CLI::App& program) {
    CompletionOf of;
    std::string paths;
    complete_command(program, "", of);
    list_paths(program, "", paths);
    return "# Completes burin's commands, options, their words and the names of its assets in bash.\n"
           "_burin() {\n"
           "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} path='' i\n"
           "  local commands='' flags='' options='' names='' words='' files=yes\n"
           "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
           "    case \"$path/${COMP_WORDS[i]}\" in\n"
           "    " +
           paths +
           ") path+=/${COMP_WORDS[i]} ;;\n"
           "    esac\n"
           "  done\n"
           "  case \"$path\" in\n" +
           of.commands +
           "  esac\n"
           "  case \"$path $prev\" in\n" +
           of.values +
           "    *)\n"
           "      if [[ \" $options \" == *\" $prev \"* ]]; then :\n"
           "      elif [[ $cur == -* ]]; then words=\"$flags $options\" files=no\n"
           "      else words=\"$commands $names\"\n"
           "      fi ;;\n"
           "  esac\n"
           "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$cur\")\n"
           "  if [[ $files == yes ]]; then\n"
           "    mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- \"$cur\")\n"
           "    compopt -o filenames 2>/dev/null\n"
           "  fi\n"
           "}\n"
           "complete -F _burin burin\n";
}

}  // namespace

std::vector<ManualFile> manual_files(const CLI::App& program, const std::string& version) {
    std::vector<ManualFile> files{{"man/burin.1", program_page(program, version)},
                                  {"bash/burin", bash_completion(program)}};
    for (const CLI::App* command : commands_of(program))
        files.push_back({"man/burin-" + command->get_name() + ".1", command_page(*command, version)});
    return files;
}

}  // namespace burin::app
