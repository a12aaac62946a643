// SPDX-License-Identifier: MIT
// Runs the burin command as a user's shell would, in a folder of its own that goes away afterwards.
#pragma once

#include <stdlib.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace burin {

class Workplace {
public:
    Workplace() {
        std::string pattern = (std::filesystem::temp_directory_path() / "burin-test-XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
    }
    ~Workplace() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    [[nodiscard]] std::string read(const std::string& name) const {
        std::ifstream in(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
    }

    struct Outcome {
        int status = -1;
        std::string output;  // standard output and error together
    };
    [[nodiscard]] Outcome run(const std::string& command) const {
        Outcome outcome;
        FILE* pipe = popen(("cd '" + folder_.string() + "' && " + command + " 2>&1").c_str(), "r");
        std::array<char, 4096> part{};
        while (std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) outcome.output.append(part.data(), n);
        const int status = pclose(pipe);
        outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return outcome;
    }

private:
    std::filesystem::path folder_;
};

inline const std::string kStrokeHeader = "time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n";

}  // namespace burin
