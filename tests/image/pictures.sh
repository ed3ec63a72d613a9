#!/bin/sh
# pictures.sh: the pictures of README.md, into assets: strip.png, the studio of the book in hard and soft
# shadows and by rays, beside one another; kettle.png, the product of the book; sundial.png and dial.png, the default scene and its
# dial from near by. Prints how far hard and soft are from the rays.
# `make pictures`.
set -eu
gnomon=${GNOMON:-build/release/gnomon}
build=${BUILD:-build/release}
folder=${O:-build}/pictures
mkdir -p "$folder"

# all without samples in a pixel, which rays have not; the sheet has a third of their size
for technique in hard cone truth; do
    "$gnomon" render -c assets/book/studio.ini --backend egl --size 1280x960 --msaa 0 --shadow "$technique" -o "$folder/$technique.png"
done
"$build/tests/tool_sheet" assets/strip.png 3/3 "$folder/hard.png" "$folder/cone.png" "$folder/truth.png"
for technique in hard cone; do
    echo "$technique: $("$gnomon" compare --share 100 "$folder/$technique.png" "$folder/truth.png" | grep -E 'RMSE|differing' | tr -s ' \n' ' ')"
done
"$gnomon" render -c assets/book/product.ini --backend egl --size 960x540 --msaa 4 -o assets/kettle.png
"$gnomon" render --backend egl --size 960x540 --msaa 4 -o assets/sundial.png
"$gnomon" render --backend egl --size 960x540 --msaa 4 --shadow pcss --camera Dial -o assets/dial.png
