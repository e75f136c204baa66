#include "base/finite.h"

#include "base/alarm.h"

namespace trunnion::inline base {

void Finite::refuse() {
    throw InputError("a result is not a finite number");
}

}  // namespace trunnion::inline base
