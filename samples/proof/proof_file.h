// Cells and references in a JSON file, their pictures as EXR files in the directory FILE.pictures beside it.
#pragma once

#include <deque>

#include "proof/cell.h"

namespace proof {

// The commit this program was built from, "-dirty" if the tree was not as committed.
const char* builtCommit();

class ProofFile {
public:
    // A file that is missing is empty. Without pictures it is not to be saved. Throws std::runtime_error
    // naming the file.
    explicit ProofFile(std::string path, bool pictures = true);

    std::deque<Reference> references;
    std::deque<Cell> cells;

    Reference* findReference(const Subject& subject);
    const Reference& referenceOf(const Cell& cell) const;   // throws if there is none
    Cell* findCell(const Subject& subject);

    // All or nothing: whoever is interrupted in it finds the last state again. Pictures of sequences that are
    // no longer in the file go: save once after dropping a cell, before it gets others.
    void save();

private:
    std::string pictureName(const Subject& subject, const char* what, size_t sequences) const;
    void removeOldPictures() const;

    std::string path_;
};

}   // namespace proof
