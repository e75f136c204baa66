#include "diagnosis/verdict/order.h"

#include <algorithm>
#include <tuple>

#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

/// The positioning error of one axis (EXX of ISO 230-1) stands in two claims, its scale and a table
/// beside it. The smaller part says nothing of another error and stands behind those.
void mark_second_parts(const Design& design, const Model& model, std::vector<Claim>& claims) {
    const auto group = [&](const Claim& claim) -> const ColumnGroup& {
        return design.group(model.members[claim.position]);
    };
    for (Claim& table : claims) {
        if (group(table).kind != GroupKind::table ||
            motion_of(group(table)) != effects::EffectKind::positioning)
            continue;
        for (Claim& scale : claims) {
            if (group(scale).kind != GroupKind::textbook ||
                motion_of(group(scale)) != effects::EffectKind::scale ||
                *group(scale).effect->axis != group(table).table.axis.axis ||
                std::min(table.probability, scale.probability) < rules::claimed)
                continue;
            (scale.share < table.share ? scale : table).second_part = true;
        }
    }
}

/// True for most of the gap of which only the name is open: none of its rivals is claimed.
bool is_open(const std::vector<Claim>& claims, const Claim& claim) {
    constexpr double most = 0.5;
    return claim.share >= most && !claim.rivals.empty() &&
           std::none_of(claims.begin(), claims.end(), [&](const Claim& other) {
               return other.probability >= rules::claimed &&
                      std::find(claim.rivals.begin(), claim.rivals.end(), other.name) !=
                          claim.rivals.end();
           });
}

}  // namespace

void put_in_order(const Design& design, const Model& model, std::vector<Claim>& claims) {
    mark_second_parts(design, model, claims);
    const std::vector<Claim> all = claims;
    const auto key = [&](const Claim& c) {
        return std::tuple(c.probability >= rules::claimed || is_open(all, c), !c.second_part,
                          c.share);
    };
    std::stable_sort(claims.begin(), claims.end(),
                     [&](const Claim& a, const Claim& b) { return key(a) > key(b); });
}

}  // namespace trunnion::diagnosis
