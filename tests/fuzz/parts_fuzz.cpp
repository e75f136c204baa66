// Any bytes as what other machines of a job wrote: parts of shards, goldens of a suite, prints of
// the pivot programs. Refused, or merged to a report.
#include "base/alarm.h"
#include "fuzz/target.h"
#include "pivot/pivot_prints.h"
#include "regression/golden.h"
#include "report/comparison_report.h"
#include "report/identification_report.h"

namespace {

using namespace trunnion;

template <class Work>
void refused_or_done(const Work& work) {
    try {
        work();
        ++fuzz::accepted;
    } catch (const InputError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(fuzz::text_of(data, size));
    refused_or_done([&] { report::merge_parts({report::parse_repetition_part(text, "f.json")}); });
    refused_or_done([&] { report::merge_parts({report::parse_part(text, "f.json")}); });
    refused_or_done([&] { regression::parse_golden(text, "f.golden"); });
    refused_or_done([&] { pivot::parse_pivot_prints({{"f.txt", text}}, Axis::B, Axis::C); });
    return 0;
}
