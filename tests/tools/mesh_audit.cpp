// SPDX-License-Identifier: MIT
// mesh_audit FILE... [--json]: counts what makes a mesh closed, two-manifold and oriented, and what does not.
// Exit status: 0 when every file is closed, has two triangles at every edge and one orientation; 1 when one is not;
// 2 when a file cannot be read or the usage is wrong.
#include <cstdio>
#include <string>
#include <vector>

#include "tests/tools/topology.hpp"

namespace mesh_audit {
namespace {

std::string json_text(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return quoted + '"';
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    const std::string printed = text;
    return printed.find_first_not_of("0123456789+-.e") == std::string::npos ? printed : "null";  // JSON has no infinity
}

std::string triple(const Point& p) { return "[" + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + "]"; }

struct Row {
    const char* name;
    std::string value;
};

std::vector<Row> rows(const Mesh& mesh, const Audit& found) {
    return {{"format", json_text(mesh.format)},
            {"vertices", std::to_string(found.vertices)},
            {"unused_vertices", std::to_string(found.unused_vertices)},
            {"nonfinite_vertices", std::to_string(found.nonfinite_vertices)},
            {"triangles", std::to_string(found.triangles)},
            {"edges", std::to_string(found.edges)},
            {"open_edges", std::to_string(found.open_edges)},
            {"nonmanifold_edges", std::to_string(found.nonmanifold_edges)},
            {"misoriented_edges", std::to_string(found.misoriented_edges)},
            {"nonmanifold_vertices", std::to_string(found.nonmanifold_vertices)},
            {"repeated_corners", std::to_string(found.repeated_corners)},
            {"zero_area_triangles", std::to_string(found.zero_area_triangles)},
            {"components", std::to_string(found.components)},
            {"euler_characteristic", std::to_string(found.euler_characteristic)},
            {"genus", found.genus ? std::to_string(*found.genus) : "null"},
            {"volume", number(found.volume)},
            {"area", number(found.area)},
            {"box_lo", triple(found.lo)},
            {"box_hi", triple(found.hi)},
            {"closed_and_oriented", found.closed_and_oriented() ? "true" : "false"}};
}

void print(const std::string& path, const std::vector<Row>& table, bool as_json) {
    if (as_json) {
        std::printf("{\"file\": %s", json_text(path).c_str());
        for (const Row& row : table) std::printf(", \"%s\": %s", row.name, row.value.c_str());
        std::printf("}\n");
        return;
    }
    std::printf("%s\n", path.c_str());
    for (const Row& row : table) std::printf("  %-22s %s\n", row.name, row.value.c_str());
}

int run(const std::vector<std::string>& arguments) {
    std::vector<std::string> paths;
    bool as_json = false;
    for (const std::string& argument : arguments) {
        if (argument == "--json") {
            as_json = true;
        } else if (argument.starts_with("--")) {
            std::fprintf(stderr, "mesh_audit: unknown option %s\n", argument.c_str());
            return 2;
        } else {
            paths.push_back(argument);
        }
    }
    if (paths.empty()) {
        std::fprintf(stderr, "usage: mesh_audit FILE... [--json]   (.stl .ply .obj .off)\n");
        return 2;
    }
    int status = 0;
    for (const std::string& path : paths) {
        const Reading reading = read_mesh(path);
        if (!reading.failure.message.empty()) {
            std::fprintf(stderr, "mesh_audit: %s %s\n", path.c_str(), reading.failure.message.c_str());
            return 2;
        }
        const Audit found = audit(reading.mesh);
        print(path, rows(reading.mesh, found), as_json);
        if (!found.closed_and_oriented()) status = 1;
    }
    return status;
}

}  // namespace
}  // namespace mesh_audit

int main(int argc, char** argv) { return mesh_audit::run({argv + 1, argv + argc}); }
