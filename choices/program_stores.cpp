#include "choices/program_stores.h"

#include "choices/inherited_variables.h"
#include "choices/offset_words.h"

namespace trunnion::choices {

ProgramStores stores_of(const std::vector<interpreter::ProgramText>& texts) {
    ProgramStores out;
    out.offsets = offset_words(texts);
    out.additional = additional_offsets(texts);
    out.fixture = fixture_offset_words(texts);
    out.variables = inherited_variables(texts);
    return out;
}

}  // namespace trunnion::choices
