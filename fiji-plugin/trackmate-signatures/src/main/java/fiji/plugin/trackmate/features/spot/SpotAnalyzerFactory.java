// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate.features.spot;

import net.imglib2.type.NativeType;
import net.imglib2.type.numeric.RealType;

public interface SpotAnalyzerFactory<T extends RealType<T> & NativeType<T>> extends SpotAnalyzerFactoryBase<T> {}
