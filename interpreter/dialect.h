// Dialects: a value given to the language and to the control, with one table of differences.
#pragma once

namespace trunnion::interpreter {

enum class DialectFamily : unsigned char { fanuc, hurco };
enum class ControlGeneration : unsigned char { fanuc_16i, fanuc_30i, fanuc_0i_f };

/// The differences relevant to the language. Rows and sources are in docs/control.md.
struct Dialect {
    DialectFamily family = DialectFamily::fanuc;
    ControlGeneration generation = ControlGeneration::fanuc_30i;
    int macro_call_levels = 5;     ///< G65/G66 nesting: 5 on 30i and 0i-F, 4 on 16i/18i (assumed)
    int subprogram_levels = 10;    ///< M98 nesting: 10, 4 on older controls (assumed)
    int total_levels = 15;         ///< both together (assumed)
    bool comment_nesting = false;  ///< Fanuc: a comment ends at the first ')'
    bool has_98000 = false;        ///< #98000-#98499
    bool has_if_blocks = false;    ///< IF [..] THEN, ELSE and ENDIF in blocks of their own
};

Dialect fanuc_dialect(ControlGeneration generation = ControlGeneration::fanuc_30i);
Dialect hurco_dialect();

}  // namespace trunnion::interpreter
