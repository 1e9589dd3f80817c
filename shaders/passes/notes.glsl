// What paired spatial reuse keeps from its first half for its second: 1 + neighbours notes a pixel, two in a word.
layout(set = RS_SET, binding = RS_BIND_NOTES, scalar) buffer RsNotes { uint rsNotes[]; };

#ifdef RS_PASS_INDIRECT
uint rsNotedNeighbours() { return rsFrame.gi.neighbours; }
#else
uint rsNotedNeighbours() { return rsFrame.di.neighbours; }
#endif
uint rsNoteWord(uvec2 pixel, uint number) { return rsIndex(pixel) * (rsNotedNeighbours() / 2u + 1u) + number / 2u; }
uint rsLoadNote(uvec2 pixel, uint number) {
    return rsNotes[rsNoteWord(pixel, number)] >> 16u * (number & 1u) & 0xffffu;
}
void rsStoreNote(uvec2 pixel, uint number, uint note) {
    uint word = rsNoteWord(pixel, number);
    rsNotes[word] = (number & 1u) == 0u ? note : rsNotes[word] & 0xffffu | note << 16u;
}
