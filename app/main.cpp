// SPDX-License-Identifier: MIT
// The burin command. Exit status: 0 done, 1 failed (one line on standard error says why), 2 wrong usage, 3 a check that
// could not tell (burin devices test).
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "app/burin_commands.hpp"
#include "app/cli/command_line.hpp"
#include "app/cli/command_table.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/version_report.hpp"
#include "base/try.hpp"

namespace burin::app {
namespace {

Result<void> write_manual(const std::vector<ManualFile>& files, const std::string& folder) {
    for (const ManualFile& file : files) {
        const std::string path = (std::filesystem::path(folder) / file.name).string();
        BURIN_TRY_DO(make_folder_of(path));
        BURIN_TRY_DO(write_text(path, file.text));
    }
    return {};
}

// Returns the exit status that a command chose for itself, or that of its Error or of a standard output that failed.
int finish(const Result<int>& outcome) {
    if (!outcome) {
        std::fprintf(stderr, "burin: %s\n", outcome.error().line().c_str());
        return 1;
    }
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return *outcome;
    std::fprintf(stderr, "burin: standard output: not all could be written; is it closed, or its disk full?\n");
    return 1;
}

}  // namespace

int run(int argc, char** argv) {
    CommandLine line("Burin, an immersive haptic workbench");
    Command program = line.program();
    bool version = false;
    program.flag("--version", version,
                 "The version, where the assets lie, engines, drivers, libraries and devices found");
    std::string manual_folder;
    program.option("--write-manual", manual_folder, "Write the manual's pages and bash's completion into this folder");
    const CommandAction named = add_commands(program, burin_commands(), [&line]() -> Result<int> {
        std::fputs(line.help().c_str(), stdout);
        return 2;
    });
    if (const auto status = line.parse(argc, argv)) return *status;
    if (version) {
        print_version();
        return 0;
    }
    if (!manual_folder.empty())
        return finish(action([&] { return write_manual(line.manual(version_text()), manual_folder); })());
    return finish(named());
}

}  // namespace burin::app

int main(int argc, char** argv) { return burin::app::run(argc, argv); }
