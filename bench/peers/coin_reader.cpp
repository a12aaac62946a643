// SPDX-License-Identifier: MIT
// burin-coin-reader FILE: has Coin read a VRML world and go through its triangles, and prints its version, how many
// there are, and the seconds of this thread that it took. A program of its own, which burin bench world runs: foreign
// files crash Coin.
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLGroup.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodes/SoShape.h>
#include <time.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

namespace {

double now_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Takes a triangle's corners into the world, as a reader of triangles has to.
struct Triangles {
    std::size_t count = 0;
    double sum = 0.0;  // kept, so that nothing is left out
};

void take(void* to, SoCallbackAction* action, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
          const SoPrimitiveVertex* c) {
    auto& triangles = *static_cast<Triangles*>(to);
    ++triangles.count;
    for (const SoPrimitiveVertex* v : {a, b, c}) {
        SbVec3f place;
        action->getModelMatrix().multVecMatrix(v->getPoint(), place);
        triangles.sum += static_cast<double>(place[0]);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    std::ifstream in(argv[1], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    SoDB::init();
    const double begin_s = now_s();
    SoInput input;
    input.setBuffer(text.data(), text.size());
    SoVRMLGroup* const root = SoDB::readAllVRML(&input);
    if (root == nullptr) return 1;
    root->ref();
    Triangles triangles;
    SoCallbackAction action;
    action.addTriangleCallback(SoShape::getClassTypeId(), take, &triangles);
    action.apply(root);
    const double seconds = now_s() - begin_s;
    if (triangles.sum != triangles.sum) return 1;
    std::printf("%s %zu %.9f\n", COIN_VERSION, triangles.count, seconds);
    root->unref();
    return 0;
}
