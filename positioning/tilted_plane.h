// The frames of G68.2, G68.3 and G68.4: position and orientation of the tilted working plane.
#pragma once

#include <array>
#include <optional>

#include "base/alarm.h"
#include "geometry/pose.h"

namespace trunnion::positioning {

/// The words of one G68.2, G68.3 or G68.4 block: mm, deg, or components of a vector. P and Q as
/// written.
struct PlaneWords {
    std::optional<double> x, y, z, i, j, k, r, p, q;
};

constexpr const char* plane_format_error_text = "G68.2/G68.3 FORMAT ERROR";

/// Alarm 5457 with the address at fault (0: a missing address or the whole block) and the reason.
class PlaneFormatError : public Alarm {
  public:
    PlaneFormatError(char letter, const char* what_is_wrong)
        : Alarm(5457, plane_format_error_text), letter(letter), what_is_wrong(what_is_wrong) {}

    char letter;
    const char* what_is_wrong;
};

/// Collects the blocks of one definition: P0, P1 and P4 take one block, P2 three or four, P3 two.
class PlaneDefinition {
  public:
    /// Adds a block. Returns the feature frame seen from the work frame when the definition is
    /// complete, else empty. Throws PlaneFormatError for a missing address, an unknown P or Q, a
    /// block out of order, collinear points, or vectors that are not perpendicular.
    ///   P0: Euler angles I J K about the moved axes, in the order of the digits of Q (313: Z-X-Z)
    ///   P1: I about X, J about Y, K about Z of the work frame, in the order given by Q (123)
    ///   P2: Q1 origin, Q2 a point on +X, Q3 a point on the +Y side; Q0 first: shift, R
    ///   P3: Q1 origin X Y Z and +X along I J K; Q2 +Z along I J K, at most 5 deg off perpendicular
    ///   P4: projection angles (assumed): I turns X about Y, J turns Y about X, K about new Z
    /// R turns the frame about its new Z.
    std::optional<Pose> add(const PlaneWords& words);
    /// True between the blocks of P2 and P3: no other block is allowed there.
    bool pending() const { return form_ != 0; }
    void reset() { *this = {}; }

  private:
    Pose from_points() const;
    Pose from_vectors() const;
    std::optional<Pose> add_point(const PlaneWords& words, int q);
    std::optional<Pose> add_vector(const PlaneWords& words, int q);

    int form_ = 0;  ///< P of the incomplete definition
    std::array<std::optional<PlaneWords>, 4> block_;
};

/// Parameters 12321 (direction) and 12322 (threshold angle).
struct VerticalAxis {
    Vector3 direction_P = Vector3::UnitZ();
    double threshold_rad = 0.0;
};

/// The frame of G68.3, seen from the work frame: Z along the tool, X = vertical x Z, then turned by
/// R about Z. Singular case: when tool and vertical are parallel within the threshold, X is the
/// work frame's X projected perpendicular to Z (assumed), or its Y when X is nearly parallel to Z.
Pose plane_of_tool(const Vector3& tool_direction_P, const Vector3& origin_P_mm, double r_deg,
                   const VerticalAxis& vertical);

}  // namespace trunnion::positioning
