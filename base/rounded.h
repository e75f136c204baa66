// Measured numbers as people read them: two digits of their sigma, else three significant digits.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::inline base {

/// A number with `decimals` digits after the point; -1 rounds to tens. Never "-0" nor an exponent;
/// "–" where there is no finite number.
std::string decimal(double value, int decimals);
/// How many decimals show two digits of this sigma (0.066: 3; 120: -1). 3 for a sigma of zero or
/// none.
int decimals_of_sigma(double sigma);
/// Three significant digits, whole numbers in full, at most `most_decimals` after the point:
/// "1234", "12.3", "0.00123", "0".
std::string three_digits(double value, int most_decimals = 9);

/// A fraction in whole percent, without the sign of percent: "97". Never "-0".
std::string percent(double fraction);
/// A probability to two decimals. What is not certain is never shown as 1 or as 0: "0.83", ">
/// 0.99",
/// "< 0.01".
std::string probability_words(double probability);

/// A value and its sigma, both to two digits of sigma: {"-8.356", "0.057"}. Without a finite sigma
/// the value has three significant digits and sigma is "–".
struct Rounded {
    std::string value, sigma;
};
Rounded rounded(double value, double sigma);
/// "-8.356 ± 0.057", or the value alone.
std::string with_sigma(double value, double sigma);

/// A size given in µm to three significant digits: "0.502 µm", "12.3 µm", from 1 mm on "32.7 mm".
std::string length_words(double length_um);
/// The same of an angle in µrad: "70.9 µrad", from 1 mrad on "2.31 mrad".
std::string angle_words(double angle_urad);
/// The unit as shown to people: "um/m" is "µm/m", "urad" is "µrad"; other units stay.
std::string shown_unit(std::string_view unit);

}  // namespace trunnion::inline base
