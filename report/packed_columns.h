// Long columns of numbers in compact form for a page; web/src/data.js unpacks them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::report {

/// One column: the value of row i is number[i] * step. Rounding to whole steps is the only loss.
struct PackedColumn {
    std::string name;
    double step = 1.0;
    std::vector<std::int64_t> number;
    int like = -1;  ///< index of an earlier column with nearly the same second differences, or -1
    int sign = 1;   ///< of that column
};

/// Enters `like` and `sign` where this makes a column shorter: the tip often follows an axis.
void find_likes(std::vector<PackedColumn>& columns);

/// Second differences, less those of the column `like`, zigzag, 7 bits a byte (low bits first),
/// column after column, deflated (zlib) and encoded in base64. All columns have the same number of
/// rows; numbers must be below 2^40. Equal columns give equal text.
std::string packed_base64(const std::vector<PackedColumn>& columns);

}  // namespace trunnion::report
