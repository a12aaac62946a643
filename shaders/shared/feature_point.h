// SPDX-License-Identifier: MIT
// Computes the position of a cell's vertex: the point nearest to the tangent planes of the surface where it crosses the
// cell's edges (the quadratic error function of Ju et al. 2002), taken about the mean of the crossings and with weak
// directions left out (Schaefer and Warren), so that it lies on a flat or curved surface, on a sharp edge, or in a
// corner.
//
// Most cells hold one, two or three smooth pieces of surface: there the point follows from the mean plane of each, in
// closed form. The remaining, rare cells need the eigenvalues; software drivers run both sides of every branch, so the
// device computes those in a separate pass and the includer chooses. Lengths in cells, from the cell's lowest corner.
//
// Included inside a C++ struct or at the top level of a shader, after feature_planes.h, that provides, for the
// crossings at hand,
//   Float3 crossing_place(uint i);
//   Float3 crossing_normal(uint i);   (of unit length)

// The point nearest to the clusters' planes, relative to the mean position; found is false where they do not determine
// one.
struct ClosedForm {
    Float3 offset;
    bool found;
};

// Computes the offset for the crossings `first` to `end`. (Three named clusters, not an array: software drivers index
// arrays one invocation after the other.)
BURIN_FN ClosedForm offset_to_planes(uint first, uint end, Float3 mean) {
    Cluster c0 = Cluster(Float3(0.0f), Float3(0.0f), 0.0f, 0.0f);
    Cluster c1 = c0;
    Cluster c2 = c0;
    int clusters = 0;  // 4 means more than three
    for (uint i = first; i < end && clusters < 4; ++i) {
        Float3 n = crossing_normal(i);
        float d = dot3(n, crossing_place(i) - mean);
        bool in_0 = clusters > 0 && in_cluster(c0.first_normal, n);
        bool in_1 = clusters > 1 && !in_0 && in_cluster(c1.first_normal, n);
        bool in_2 = clusters > 2 && !in_0 && !in_1 && in_cluster(c2.first_normal, n);
        bool opens = !in_0 && !in_1 && !in_2;
        c0 = cluster_with(c0, opens && clusters == 0, in_0, n, d);
        c1 = cluster_with(c1, opens && clusters == 1, in_1, n, d);
        c2 = cluster_with(c2, opens && clusters == 2, in_2, n, d);
        clusters += opens ? 1 : 0;
    }
    Float3 n0 = mean_normal(c0.normal_sum, length3(c0.normal_sum));
    Float3 n1 = mean_normal(c1.normal_sum, length3(c1.normal_sum));
    Float3 n2 = mean_normal(c2.normal_sum, length3(c2.normal_sum));
    float d0 = mean_offset(c0.offset_sum, c0.count);
    float d1 = mean_offset(c1.offset_sum, c1.count);
    float d2 = mean_offset(c2.offset_sum, c2.count);
    ClosedForm form;
    form.offset = Float3(0.0f);
    form.found = false;
    if (clusters == 1) {
        form.offset = offset_to_plane(n0, d0);
        form.found = true;
    }
    if (clusters == 2) {
        float cosine = dot3(n0, n1);
        float sine2 = squared_sine(cosine);
        form.found = sine2 >= kLeastSine2;
        form.offset = offset_to_line(n0, d0, n1, d1, cosine, sine2);
    }
    if (clusters == 3) {
        Float3 across = cross3(n1, n2);
        float volume = dot3(n0, across);
        form.found = abs(volume) >= kLeastVolume;
        form.offset = offset_to_corner(n0, d0, n1, d1, n2, d2, across, volume);
    }
    return form;
}

// Computes the offset for any set of planes: the pseudo-inverse of their normal equations.
BURIN_FN Float3 offset_by_eigenvalues(uint first, uint end, Float3 mean) {
    float xx = 0.0f;
    float xy = 0.0f;
    float xz = 0.0f;
    float yy = 0.0f;
    float yz = 0.0f;
    float zz = 0.0f;
    Float3 atb = Float3(0.0f);
    for (uint i = first; i < end; ++i) {
        Float3 n = crossing_normal(i);
        float d = dot3(n, crossing_place(i) - mean);
        BURIN_PRECISE float sum_xx = xx + n[0] * n[0];
        BURIN_PRECISE float sum_xy = xy + n[0] * n[1];
        BURIN_PRECISE float sum_xz = xz + n[0] * n[2];
        BURIN_PRECISE float sum_yy = yy + n[1] * n[1];
        BURIN_PRECISE float sum_yz = yz + n[1] * n[2];
        BURIN_PRECISE float sum_zz = zz + n[2] * n[2];
        BURIN_PRECISE Float3 sum_b = atb + n * d;
        xx = sum_xx;
        xy = sum_xy;
        xz = sum_xz;
        yy = sum_yy;
        yz = sum_yz;
        zz = sum_zz;
        atb = sum_b;
    }
    float a[3][3];
    a[0][0] = xx;
    a[0][1] = xy;
    a[1][0] = xy;
    a[0][2] = xz;
    a[2][0] = xz;
    a[1][1] = yy;
    a[1][2] = yz;
    a[2][1] = yz;
    a[2][2] = zz;
    Float3 vectors[3];
    vectors[0] = Float3(1.0f, 0.0f, 0.0f);
    vectors[1] = Float3(0.0f, 1.0f, 0.0f);
    vectors[2] = Float3(0.0f, 0.0f, 1.0f);
    for (int turn = 0; turn < 15; ++turn) {  // five sweeps of cyclic Jacobi rotations: float precision
        int p = turn % 3 == 2 ? 1 : 0;
        int q = turn % 3 == 0 ? 1 : 2;
        if (abs(a[p][q]) < 1e-12f) continue;
        BURIN_PRECISE float theta = exact_quotient(a[q][q] - a[p][p], 2.0f * a[p][q]);
        BURIN_PRECISE float t =
            exact_quotient(theta >= 0.0f ? 1.0f : -1.0f, abs(theta) + exact_root(theta * theta + 1.0f));
        BURIN_PRECISE float c = exact_quotient(1.0f, exact_root(t * t + 1.0f));
        BURIN_PRECISE float s = t * c;
        for (int k = 0; k < 3; ++k) {
            float kp = a[k][p];
            float kq = a[k][q];
            BURIN_PRECISE float new_p = c * kp - s * kq;
            BURIN_PRECISE float new_q = s * kp + c * kq;
            a[k][p] = new_p;
            a[k][q] = new_q;
        }
        for (int k = 0; k < 3; ++k) {
            float pk = a[p][k];
            float qk = a[q][k];
            BURIN_PRECISE float new_p = c * pk - s * qk;
            BURIN_PRECISE float new_q = s * pk + c * qk;
            a[p][k] = new_p;
            a[q][k] = new_q;
        }
        Float3 vp = vectors[p];
        Float3 vq = vectors[q];
        BURIN_PRECISE Float3 new_vp = c * vp - s * vq;
        BURIN_PRECISE Float3 new_vq = s * vp + c * vq;
        vectors[p] = new_vp;
        vectors[q] = new_vq;
    }
    float largest = max(max(a[0][0], a[1][1]), a[2][2]);
    BURIN_PRECISE Float3 offset = Float3(0.0f);
    for (int k = 0; k < 3; ++k) {
        float value = a[k][k];
        if (value > kEigenvalueCutoff * largest) offset += vectors[k] * exact_quotient(dot3(vectors[k], atb), value);
    }
    return offset;
}
