#include "diagnosis/verdict/verdict_kind.h"

namespace trunnion::diagnosis {

const char* to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::no_gap: return "no-gap";
        case Verdict::explained: return "explained";
        case Verdict::partly_explained: return "partly-explained";
        case Verdict::ambiguous: return "ambiguous";
        case Verdict::unexplained: return "unexplained";
    }
    return "";
}

}  // namespace trunnion::diagnosis
