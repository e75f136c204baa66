#include "imports/import.h"

#include <utility>

#include "records/readings.h"

namespace trunnion::imports {

Imported import_readings(ImportKind kind, const ImportRequest& request) {
    using Function = Imported (*)(const ImportRequest&);
    static constexpr Function functions[] = {import_ballbar,  import_iso230_2, import_points,
                                             import_axis_log, import_table,    import_dprnt};
    return functions[static_cast<std::size_t>(kind)](request);
}

}  // namespace trunnion::imports
