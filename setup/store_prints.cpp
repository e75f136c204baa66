#include "setup/store_prints.h"

#include <fmt/format.h>

namespace trunnion::setup {

std::string store_prints(const RotaryStores& stores, bool hurco, const std::string& probe_offset) {
    std::string text =
        "#7=#5201+#5221\n#8=#5202+#5222\n#9=#5203+#5223\n"
        "DPRNT[STORE*G54*X#7[47]*Y#8[47]*Z#9[47]]\n"
        "#7=PRM[1001,0]\nDPRNT[STORE*INCH*#7[10]]\n";
    // The sum is the same whichever of the two ranges is the wear (6000#3).
    if (!probe_offset.empty())
        text += fmt::format(
            "(TOOL OFFSET MEMORY A, ONE VALUE A TOOL, HAS NO #11001 AND UP:)\n"
            "(DELETE +#[11000+#8] IN THE SECOND OF THE NEXT LINES)\n"
            "#8={}\n#7=#[10000+#8]+#[11000+#8]\nDPRNT[STORE*H#8[30]*V#7[47]]\n",
            probe_offset);
    if (hurco) return text;
    for (const StoreNumber& n : store_numbers(stores))
        if (n.parameter != 0)
            text += fmt::format("#7=PRM[{0}]\nDPRNT[STORE*N{0}*V#7[47]]\n", n.parameter);
    return text + "#7=#3011\nDPRNT[STORE*DATE*V#7[80]]\n";
}

}  // namespace trunnion::setup
