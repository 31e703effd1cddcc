// Conversion of measured values between units.
#include "messages/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace whirl_twin {
namespace units_test {

TEST(Units, AreBroughtToWhatIsWanted) {
  EXPECT_EQ(unitScale("m", "m"), 1.0);
  EXPECT_DOUBLE_EQ(unitScale("mm", "m"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("um", "mm"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("deg", "rad"), M_PI / 180.0);
  EXPECT_DOUBLE_EQ(unitScale("mm/s", "m/s"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("mN m", "N m"), 1.0e-3);
  EXPECT_EQ(unitScale("V", "V"), 1.0);
  EXPECT_DOUBLE_EQ(unitScale("kN/mm", "N/m"), 1.0e6);
  EXPECT_DOUBLE_EQ(unitScale("g mm", "kg m"), 1.0e-6);
  EXPECT_DOUBLE_EQ(unitScale("kg cm^2", "kg m^2"), 1.0e-4);
  EXPECT_DOUBLE_EQ(unitScale("GPa", "Pa"), 1.0e9);
  EXPECT_DOUBLE_EQ(unitScale("cP", "Pa s"), 1.0e-3);
  EXPECT_DOUBLE_EQ(unitScale("%", "-"), 0.01);
  EXPECT_DOUBLE_EQ(unitScale("1/ms", "1/s"), 1.0e3);
  EXPECT_DOUBLE_EQ(unitScale("µm", "m"), 1.0e-6);
}

// NIST SP 811, appendix B: 1 lbf/in is 175.1268 N/m, 1 psi 6894.757 Pa, 1 lb/in^3 27679.90 kg/m^3.
TEST(Units, OfInchAndPound) {
  EXPECT_NEAR(unitScale("lbf/in", "N/m"), 175.1268, 5e-5);
  EXPECT_NEAR(unitScale("psi", "Pa"), 6894.757, 5e-4);
  EXPECT_NEAR(unitScale("lb/in^3", "kg/m^3"), 27679.90, 5e-3);
  EXPECT_NEAR(unitScale("lbf s/in", "N s/m"), 175.1268, 5e-5);
  EXPECT_NEAR(unitScale("reyn", "Pa s"), 6894.757, 5e-4);
  EXPECT_DOUBLE_EQ(unitScale("mil", "um"), 25.4);
  EXPECT_DOUBLE_EQ(unitScale("um/(g m)", "m/(kg m)"), 1.0e-3);
}

TEST(Units, ATurnIsTwoPi) {
  EXPECT_DOUBLE_EQ(unitScale("rpm", "rad/s"), M_PI / 30.0);
  EXPECT_DOUBLE_EQ(unitScale("Hz", "rad/s"), 2.0 * M_PI);
  EXPECT_DOUBLE_EQ(unitScale("rpm", "Hz"), 1.0 / 60.0);
  EXPECT_DOUBLE_EQ(unitScale("rev", "rad"), 2.0 * M_PI);
  EXPECT_DOUBLE_EQ(unitScale("rpm/s", "rad/s^2"), M_PI / 30.0);
  EXPECT_EQ(unitScale("Hz", "1/s"), 0.0) << "a decay of so many 1/s is not of so many Hz";
}

TEST(Units, ThatAreNotSaidAreAsWanted) {
  EXPECT_EQ(unitScale("", "m"), 1.0);
}

TEST(Units, OfAnotherKindAreNotTaken) {
  EXPECT_EQ(unitScale("rad", "m"), 0.0);
  EXPECT_EQ(unitScale("m/s", "m"), 0.0);
  EXPECT_EQ(unitScale("m", "m/s"), 0.0);
  EXPECT_EQ(unitScale("V", "m"), 0.0);
  EXPECT_EQ(unitScale("N", "N m"), 0.0);
  EXPECT_EQ(unitScale("lb", "lbf"), 0.0) << "a mass is no force";
  EXPECT_EQ(unitScale("mm", "-"), 0.0);
  EXPECT_EQ(unitScale("furlong", "m"), 0.0);
  for (const char* none : {"", "-", "10", "m + 1", "m @ 5", "lg(re 1 m)", "rmp"}) {
    EXPECT_FALSE(isUnit(none)) << none;
  }
}

// In the SI: from NIST SP 811, appendix B, or from the definitions (inch, pound, gravity).
const std::map<std::string, double> kFactors = {{"mm", 1e-3},
                                                {"cm", 1e-2},
                                                {"um", 1e-6},
                                                {"µm", 1e-6},
                                                {"micron", 1e-6},
                                                {"microns", 1e-6},
                                                {"in", 0.0254},
                                                {"inch", 0.0254},
                                                {"inches", 0.0254},
                                                {"mil", 2.54e-5},
                                                {"mils", 2.54e-5},
                                                {"thou", 2.54e-5},
                                                {"ft", 0.3048},
                                                {"g", 1e-3},
                                                {"t", 1e3},
                                                {"lb", 0.45359237},
                                                {"lbm", 0.45359237},
                                                {"oz", 0.028349523125},
                                                {"ns", 1e-9},
                                                {"us", 1e-6},
                                                {"ms", 1e-3},
                                                {"min", 60.0},
                                                {"h", 3600.0},
                                                {"hr", 3600.0},
                                                {"mrad", 1e-3},
                                                {"deg", 0.017453292519943296},
                                                {"degree", 0.017453292519943296},
                                                {"degrees", 0.017453292519943296},
                                                {"°", 0.017453292519943296},
                                                {"rev", 6.283185307179586},
                                                {"rpm", 0.10471975511965977},
                                                {"RPM", 0.10471975511965977},
                                                {"rev/min", 0.10471975511965977},
                                                {"r/min", 0.10471975511965977},
                                                {"cpm", 0.10471975511965977},
                                                {"rps", 6.283185307179586},
                                                {"Hz", 6.283185307179586},
                                                {"kHz", 6283.185307179586},
                                                {"deg/s", 0.017453292519943296},
                                                {"rpm/s", 0.10471975511965977},
                                                {"r/min/s", 0.10471975511965977},
                                                {"Hz/s", 6.283185307179586},
                                                {"deg/s^2", 0.017453292519943296},
                                                {"mm/s", 1e-3},
                                                {"in/s", 0.0254},
                                                {"mm/s^2", 1e-3},
                                                {"in/s^2", 0.0254},
                                                {"g mm", 1e-6},
                                                {"gmm", 1e-6},
                                                {"g m", 1e-3},
                                                {"kg mm", 1e-3},
                                                {"oz in", 7.20077887375e-4},
                                                {"lb in", 0.011521246198},
                                                {"kg mm^2", 1e-6},
                                                {"kg cm^2", 1e-4},
                                                {"g mm^2", 1e-9},
                                                {"lb in^2", 2.926396534292e-4},
                                                {"g/cm^3", 1e3},
                                                {"lb/in^3", 27679.904710203125},
                                                {"kN", 1e3},
                                                {"kgf", 9.80665},
                                                {"lbf", 4.4482216152605},
                                                {"ozf", 0.27801385095378125},
                                                {"Nm", 1.0},
                                                {"kNm", 1e3},
                                                {"N mm", 1e-3},
                                                {"J", 1.0},
                                                {"lbf in", 0.1129848290276167},
                                                {"lbf ft", 1.3558179483314004},
                                                {"N/mm", 1e3},
                                                {"kN/mm", 1e6},
                                                {"MN/m", 1e6},
                                                {"lbf/in", 175.12683524647636},
                                                {"N s/mm", 1e3},
                                                {"lbf s/in", 175.12683524647636},
                                                {"kN m/rad", 1e3},
                                                {"lbf in/rad", 0.1129848290276167},
                                                {"lbf in s/rad", 0.1129848290276167},
                                                {"kPa", 1e3},
                                                {"MPa", 1e6},
                                                {"GPa", 1e9},
                                                {"bar", 1e5},
                                                {"psi", 6894.757293168362},
                                                {"ksi", 6894757.293168362},
                                                {"mPa s", 1e-3},
                                                {"P", 0.1},
                                                {"cP", 1e-3},
                                                {"reyn", 6894.757293168362},
                                                {"kW", 1e3},
                                                {"MW", 1e6},
                                                {"hp", 745.6998715822702},
                                                {"l", 1e-3},
                                                {"L", 1e-3},
                                                {"cm^3", 1e-6},
                                                {"mK", 1e-3},
                                                {"mA", 1e-3},
                                                {"mV", 1e-3},
                                                {"kOhm", 1e3},
                                                {"mH", 1e-3},
                                                {"mT", 1e-3},
                                                {"1/min", 1.0 / 60.0},
                                                {"%", 1e-2},
                                                {"percent", 1e-2}};

TEST(Units, EachOfTheListHasItsFactor) {
  std::size_t count = 0;
  for (const QuantityUnits& quantity : unitsByQuantity()) {
    for (const char* unit : quantity.units) {
      ++count;
      ASSERT_EQ(kFactors.count(unit), 1u) << unit;
      const double factor = kFactors.at(unit);
      EXPECT_TRUE(isUnit(unit)) << unit;
      EXPECT_NEAR(unitScale(unit, quantity.unit), factor, 1e-15 * factor) << unit;
      EXPECT_EQ(quantityName(unit), quantity.name) << unit;
    }
  }
  EXPECT_EQ(count, kFactors.size());
}

TEST(Units, TheOneMeantIsNamed) {
  EXPECT_EQ(unitMeant("lb/in", "N/m"), "lbf/in");
  EXPECT_EQ(unitMeant("lb s/in", "N s/m"), "lbf s/in");
  EXPECT_EQ(unitMeant("kg/mm", "N/m"), "kgf/mm");
  EXPECT_EQ(unitMeant("lbf", "kg"), "lb");
  EXPECT_EQ(unitMeant("oz", "N"), "ozf");
  EXPECT_EQ(unitMeant("hz", "rad/s"), "Hz");
  EXPECT_EQ(unitMeant("Rpm", "rad/s"), "rpm");
  EXPECT_EQ(unitMeant("kg", "rad/s"), "");
  EXPECT_EQ(unitMeant("", "m"), "");
}

TEST(Units, AFactorIsNoPartOfAUnit) {
  for (const char* none :
       {"rpm 2", "m 3", "m/2", "m*2", "m.5", "2 m", "1/2 s", "1/", "m/(2 s)", "lg(mW)", "(m)",
        "\xff", "rpm\xff", "rpm\xc2", "rpm\xc3(", "rpm\n", "rpm\xe2\x80\xae"}) {
    EXPECT_FALSE(isUnit(none)) << none;
  }
  for (const char* unit : {"kg m2", "m^2/s^2", "1/s", "N.m", "N m/rad"}) {
    EXPECT_TRUE(isUnit(unit)) << unit;
  }
}

TEST(Units, OfANoiseArePerRootOfHz) {
  EXPECT_DOUBLE_EQ(unitScale("mm/s^2/sqrt(Hz)", "m/s^2/sqrt(Hz)"), 1e-3);
  EXPECT_TRUE(isUnit("um/sqrt(Hz)"));
  EXPECT_EQ(unitScale("um", "m/sqrt(Hz)"), 0.0);
  EXPECT_EQ(unitScale("um/sqrt(Hz)", "m"), 0.0);
  EXPECT_EQ(unitScale("deg/sqrt(Hz)", "m/sqrt(Hz)"), 0.0);
}

}  // namespace units_test
}  // namespace whirl_twin
