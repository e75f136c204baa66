// NC text of the ballbar programs, with placeholders in braces for letters and values.
#pragma once

namespace trunnion::ballbar::test::ballbar_text {

extern const char* const main_program;       ///< O8200
extern const char* const kinematic_program;  ///< O8300
extern const char* const data_program;       ///< O8210-O8230: data, stations, planar test, arc
extern const char* const rotary_program;     ///< O8240, O8241; O8250, O8251
extern const char* const switch_program;     ///< O8260, O8261: TCP on and off

}  // namespace trunnion::ballbar::test::ballbar_text
