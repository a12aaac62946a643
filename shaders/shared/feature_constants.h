// SPDX-License-Identifier: MIT
// The constants that decide where a cell's vertices lie (feature_planes.h, feature_point.h) and how many there are
// (cell_vertex.h).
#ifndef BURIN_SHARED_FEATURE_CONSTANTS_H
#define BURIN_SHARED_FEATURE_CONSTANTS_H
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

// Normals closer to a cluster's first than this (cosine, about 23 degrees) belong to one smooth piece of surface. A
// crease shallower than that is less than a tenth of a cell deep within a cell.
const float kSameCluster = 0.92f;
// Planes that meet at less than about 10 degrees do not determine a line (squared sine), nor do three whose normals
// nearly share a plane determine a point (volume of the normals).
const float kLeastSine2 = 0.03f;
const float kLeastVolume = 0.1f;
// Directions with less than this share of the largest eigenvalue carry no position, only noise.
const float kEigenvalueCutoff = 0.02f;
// Where planes meet, a vertex may lie this far outside its cell (in cells): an edge or a corner that passes close by a
// cell often has no crossing on the edges of the cell that it lies in, and would otherwise be cut off.
const float kOutside = 0.5f;
// On a curved surface the mean of the crossings lies inside the curve, by some distance e, and the mean of their
// tangent planes as far outside it. The triangles between the vertices sag to the inside by about e once more. Three
// quarters of the way from the mean to the planes the volume is right, and the vertices lie e / 2 outside.
const float kTowardsTangents = 0.75f;

// Crossings whose normals are closer than this (cosine, about 41 degrees) belong to one smooth piece of surface.
const float kSmooth = 0.75f;
// Across a change of material already a smaller angle (about 10 degrees) is an edge: the vertex lies on it, so each
// side can keep its own colour. Where the surface continues smoothly the border lies anywhere in the cell, and the
// colours blend.
const float kSmoothAcrossMaterials = 0.985f;

BURIN_SHARED_END
#endif
