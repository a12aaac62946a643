// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Computes where an end is moved, or made: one invocation an end. The field is evaluated in one place of the text, up
// to five times, for one question after the other.
#define SMOOTH_GRADIENT
#include "shaders/smooth_buffers.glsl"
#include "shaders/smooth_near.glsl"

const int kVanished = 0;  // whether what is between this end and the next has vanished
const int kRoot = 1;      // where the field's zero is on the edge
const int kMade = 2;      // the normal of an end that is made
const int kDone = 3;

// Returns the material of the nearest point of the surface, of the first one where there are several. Looks at larger
// and larger boxes around the place, until no point outside can be nearer.
uint material_near(SmoothTask task, dvec3 place, double width, uint otherwise) {
    double reach = min(2.0, width);
    uint material = otherwise;
    near_left = kMostNearest;
    for (bool is_found = false; !is_found;) {
        double least2 = width * width;
        material = otherwise;
        begin_near(task, 0, place, reach);
        while (has_near_row()) {
            take_near_row();
            for (; near_next < near_end; ++near_next) {
                dvec3 off = sorted[near_next].place_area.xyz - place;
                if (dot3(off, off) < least2) {
                    least2 = dot3(off, off);
                    material = sorted[near_next].key_box.w;
                }
            }
        }
        check_near();
        is_found = reach >= width || least2 < 0.75 * reach * reach || near_left < 0;
        reach = min(4.0 * reach, width);
    }
    return material;
}

// Returns the share of the edge from which to look for the root of the field on an edge that has no end yet; below zero
// where there is nothing to go by.
double share_between_nodes(SmoothTask task, SmoothEdge edge, bool low_inside) {
    ivec3 low = node_on_ray(edge.axis, edge.u, edge.v, edge.low);
    ivec3 high = node_on_ray(edge.axis, edge.u, edge.v, edge.low + 1);
    SmoothNode below = nodes[index_of_node(task, low.x, low.y, low.z)];
    SmoothNode above = nodes[index_of_node(task, high.x, high.y, high.z)];
    if ((below.flags & above.flags & kIsKnown) == 0u) return -1.0;
    if ((below.field < 0.0) != low_inside || (above.field < 0.0) == low_inside) return -1.0;
    return below.field / (below.field - above.field);
}

SmoothEnd job;
SmoothEdge edge;
DexelEnd old = DexelEnd(0u, 0u);  // the end that is moved, and the next
DexelEnd next = DexelEnd(0u, 0u);
double was = 0.5;       // shares of the edge: where it is, or is looked for from, and where the field's zero is
double root;
double by_share = 1.0;  // of the way that it is moved
int question = kRoot;
int newton_steps = 0;
bool is_found = false;
dvec3 normal = dvec3(0.0);

bool is_made() { return (job.flags & kIsMade) != 0u; }
bool is_low_inside() { return (job.flags & kLowInside) != 0u; }

// Finds out what there is to ask first.
void begin_questions(SmoothTask task, SmoothPath path) {
    if (is_made()) {
        double share = share_between_nodes(task, edge, is_low_inside());
        bool has_share = share >= 0.0;
        if (has_share) was = share;
        if (!has_share || smoothing_at(path, place_on_edge(edge, was)).share < 1.0) question = kMade;
    } else {
        RayRef ray = rays[index_of_ray(edge.axis, edge.u, edge.v)];
        old = store.at[ray.first + job.number];
        was = share_of_depth(edge, depth_of(old));
        by_share = smoothing_at(path, place_on_edge(edge, was)).share;
        if (is_too_weak(by_share)) question = kDone;
        if ((job.flags & kHasNext) != 0u) {
            next = store.at[ray.first + job.number + 1u];
            question = kVanished;
        }
    }
    root = was;
    job.result = old;
}

// Returns the place on the edge that the question is about.
dvec3 place_of_question() {
    double share = root;
    if (question == kVanished) share = was + half_between(old, next);
    if (question == kMade) share = clamp(root, 0.0, 1.0);
    return place_on_edge(edge, share);
}

void note_between(double share, FieldValue value) {
    bool is_inside = (job.flags & kInsideBetween) != 0u;
    if (share > 0.0 && value.known &&
        has_vanished(edge, old, half_between(old, next), is_inside, share, value.distance))
        job.is_gone = 1u;
    question = job.is_gone != 0u || is_too_weak(by_share) ? kDone : kRoot;
}

// Takes a step of Newton's method towards the field's zero.
void step_to_root(FieldValue value) {
    bool is_last = !value.known || newton_steps + 1 == kNewtonSteps;
    if (value.known) {
        normal = value.gradient;
        is_found = true;
    }
    if (!is_last) {
        double by = newton_step(value.distance, value.gradient[edge.axis]);
        root += by;
        is_last = abs(by) < kSmallStep;
    }
    ++newton_steps;
    if (!is_last) return;
    question = is_made() ? kMade : kDone;
    if (!is_made() && is_found) job.result = moved_end(old, edge.low, was, root, by_share, normal);
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (is_stopped() || number >= smooth_counts.ends) return;
    SmoothTask task = tasks[parameters.ball];
    SmoothPath path = path_of(task);
    job = smooth_ends[number];
    edge = SmoothEdge(axis_of(job.ray), u_of(job.ray), v_of(job.ray), job.low);
    begin_questions(task, path);
    for (int turn = 0; turn < 5 && question != kDone; ++turn) {
        dvec3 place = place_of_question();
        Smoothing smoothing = smoothing_at(path, place);
        FieldValue value = field_at(task, place, smoothing.width);
        if (question == kVanished) {
            note_between(smoothing.share, value);
        } else if (question == kRoot) {
            step_to_root(value);
        } else {
            uint material = material_near(task, place, 2.0 * smoothing.width.value, task.material);
            job.result = made_end(edge, root, material, is_low_inside(), value.known, value.gradient);
            question = kDone;
        }
    }
    if (question != kDone) stop(kBeyondDevice);  // a software driver has ended the loop
    smooth_ends[number].result = job.result;
    smooth_ends[number].is_gone = job.is_gone;
}
