#include "controller/code_calls.h"

#include <cstdlib>

#include "offsets/whole_parameter.h"

namespace trunnion::controller {

interpreter::CodeCalls decode_code_calls(const offsets::Parameters& parameters) {
    interpreter::CodeCalls calls;
    const auto code_of = [&](int number) {
        return offsets::whole_parameter(parameters.get(number));  // 0: no call
    };
    for (int i = 0; i < 10; ++i) {
        if (const int g = code_of(6050 + i)) calls.g[std::abs(g) * 10] = {9010 + i, true, g < 0};
        if (const int m = code_of(6080 + i)) calls.m[m] = {9020 + i, true, false};
    }
    for (int i = 1; i < 10; ++i)
        if (const int m = code_of(6070 + i)) calls.m[m] = {9000 + i, false, false};
    calls.t_calls_9000 = parameters.bit(6001, 5);
    return calls;
}

}  // namespace trunnion::controller
