#include "records/with_values.h"

#include <catch2/catch.hpp>

using namespace trunnion;

namespace {

/// The text with the value 0.5 (mm or rad) in each row with a device.
std::string rewritten(const std::string& text) {
    std::vector<std::string> notes;
    records::ReadingTable table = records::parse_readings(text, "r.csv", notes);
    for (records::Reading& row : table.rows)
        if (row.device != records::Device::none) row.value_mm = 0.5;
    return records::with_values(text, table);
}

}  // namespace

TEST_CASE("a table keeps all but its values") {
    CHECK(rewritten("# source = real\n"
                    "# a remark, with a comma\n"
                    "\n"
                    "value_mm,index,operator,time_s,test,device,feature,x_mm,dir_x,dir_y,dir_z\r\n"
                    "9e-1 ,0,\"a,b\",0.0,m,sphere,S,1.50,1,0,0\r\n"
                    "7,1, Jo ,1.0,m,,S,+2,,,\n"
                    " ,2,,2.0,\"m\",sphere,S,3.000,1,0,0") ==
          "# source = real\n"
          "# a remark, with a comma\n"
          "\n"
          "value_mm,index,operator,time_s,test,device,feature,x_mm,dir_x,dir_y,dir_z\r\n"
          "0.5 ,0,\"a,b\",0.0,m,sphere,S,1.50,1,0,0\r\n"
          "7,1, Jo ,1.0,m,,S,+2,,,\n"
          " 0.5,2,,2.0,\"m\",sphere,S,3.000,1,0,0");
}

TEST_CASE("values stand beside the geometry that was declared for them") {
    std::vector<std::string> notes;
    const std::string text =
        "# declared chain = old\n#\nindex,time_s,test,device,feature,x_mm,value_mm\n0,0,m,,,1,\n";
    records::ReadingTable table = records::parse_readings(text, "r.csv", notes);
    table.comment["declared chain"] = "new";
    CHECK(records::with_values(text, table) == "# declared chain = new" + text.substr(22));
}

TEST_CASE("a table of degrees without their column gets it") {
    CHECK(rewritten("\xEF\xBB\xBFindex;time_s;test;device;feature;x_mm;dir_x;dir_y;dir_z;value_mm\n"
                    "0;0;a;angle;R;1;0;0;1;\n"
                    "1;1;a;linear;R;1;0;0;1;\"3\"\n"
                    "2;2;a;;;1;;;;\n") ==
          "index;time_s;test;device;feature;x_mm;dir_x;dir_y;dir_z;value_mm;value_deg\n"
          "0;0;a;angle;R;1;0;0;1;;28.64788975654116\n"
          "1;1;a;linear;R;1;0;0;1;\"0.5\";\n"
          "2;2;a;;;1;;;;;\n");
}
