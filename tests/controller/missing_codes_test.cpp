// Codes of options that are not emulated: each is refused, none of them is a code of the control.
#include "controller/missing_codes.h"

#include <catch2/catch.hpp>

#include "controller/g_codes.h"

namespace trunnion::controller {

TEST_CASE("a code is of the control, or of a missing option, or of neither", "[codes]") {
    int own = 0, missing = 0;
    for (int code10 = 0; code10 < 10000; ++code10) {
        CAPTURE(code10);
        const bool has = find_g_code(code10 / 10.0), lacks = missing_option(code10);
        CHECK_FALSE((has && lacks));
        own += has;
        missing += lacks;
    }
    CHECK(own > 100);
    CHECK(missing == 53);
    CHECK(missing_option(62) == std::string("NURBS interpolation"));
    CHECK(missing_option(1610) == std::string("infeed control"));
    CHECK(missing_option(22) == std::string("involute interpolation"));
    CHECK_FALSE(missing_option(7770));
}

}  // namespace trunnion::controller
