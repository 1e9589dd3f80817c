#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_table.glsl"

void main() {
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        uint column = rsItem(k);
        if (column >= rsPass.columns) continue;
        RsColumn result =
            rsState.heaviestPower > 0u ? rsAliasColumn(column, rsPass.columns) : rsDarkColumn(column);
        rsAlias[column] = result.entry;
        if (column < rsPass.lights) rsLights[column].selection = result.selection;
    }
}
